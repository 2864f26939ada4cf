// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <chrono>
#include <memory>
#include <thread>

#include "doubles/child_program.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {

// A PipeWire of the test's own, without a session manager: nothing is linked but by the test.
class PrivatePipeWire {
 public:
  PrivatePipeWire() { start(); }

  void start() {
    std::filesystem::create_directories(folder_ / "run");
    std::filesystem::remove(socket());
    folder_.write("pipewire.conf", config);
    daemon_ = std::make_unique<ChildProgram>(
        std::vector<std::string>{"pipewire"},
        std::vector<std::string>{"PIPEWIRE_RUNTIME_DIR=" + (folder_ / "run").string(),
                                 "PIPEWIRE_CONFIG_DIR=" + folder_.path().string(), "PIPEWIRE_DEBUG=0"});
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    int fd = -1;
    while ((fd = connect()) < 0) {
      if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("pipewire does not start");
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ::close(fd);
  }
  void end() { daemon_->end(); }

  // A new connection; -1 if there is none to be had.
  [[nodiscard]] int connect() const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = socket().string();
    if (path.size() >= sizeof address.sun_path) throw std::runtime_error("the temporary folder's name is too long");
    path.copy(address.sun_path, path.size());
    const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0) throw std::runtime_error("no socket can be made");
    if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
    ::close(fd);
    return -1;
  }

 private:
  static constexpr const char* config = R"(
    context.properties = { core.daemon = true core.name = pipewire-0 support.dbus = false mem.allow-mlock = false }
    context.spa-libs = { support.* = support/libspa-support }
    context.modules = [
      { name = libpipewire-module-protocol-native }
      { name = libpipewire-module-client-node }
      { name = libpipewire-module-access }
      { name = libpipewire-module-adapter }
      { name = libpipewire-module-metadata }
      { name = libpipewire-module-link-factory }
    ])";

  [[nodiscard]] std::filesystem::path socket() const { return folder_ / "run/pipewire-0"; }

  TemporaryFolder folder_;
  std::unique_ptr<ChildProgram> daemon_;
};

}  // namespace telehug
