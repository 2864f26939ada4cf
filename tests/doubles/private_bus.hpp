// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "doubles/child_program.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {

// A D-Bus of the test's own, on which nothing is but what the test puts there.
class PrivateBus {
 public:
  PrivateBus() {
    if (!address_.starts_with("unix:")) throw std::runtime_error("dbus-daemon does not start: " + address_);
  }
  [[nodiscard]] const std::string& address() const { return address_; }

 private:
  std::string config() const {
    return folder_
        .write("bus.conf", "<busconfig><type>session</type><listen>unix:path=" + (folder_ / "bus").string() +
                               "</listen><policy context='default'><allow send_destination='*'/>"
                               "<allow receive_sender='*'/><allow own='*'/></policy></busconfig>")
        .string();
  }

  TemporaryFolder folder_;
  ChildProgram daemon_{{"dbus-daemon", "--config-file=" + config(), "--nofork", "--print-address"}};
  std::string address_ = daemon_.read_line();
};

}  // namespace telehug
