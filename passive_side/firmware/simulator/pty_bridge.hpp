// SPDX-License-Identifier: Apache-2.0
//
// A pseudo terminal whose other end looks like the jacket's serial port.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace telehug {

class PtyBridge {
 public:
  // Makes the terminal and, if `link` is not empty, a symbolic link to it: complete the moment it appears, in place of
  // a link that is there already, and removed with this object. Throws std::system_error.
  explicit PtyBridge(std::filesystem::path link);
  ~PtyBridge();
  PtyBridge(const PtyBridge&) = delete;
  PtyBridge& operator=(const PtyBridge&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int fd() const { return master_; }

  // What the host has written, as far as it has come; never waits.
  [[nodiscard]] std::vector<std::uint8_t> read();
  // Bytes for which there is no room get lost, as on a wire to which nobody listens.
  void write(std::span<const std::uint8_t> bytes);

 private:
  int master_ = -1;
  int slave_ = -1;  // kept open: without it, every read between two hosts is an error
  std::string path_;
  std::filesystem::path link_;
};

}  // namespace telehug
