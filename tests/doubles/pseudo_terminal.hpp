// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace telehug {

// A serial device whose other end the test holds; unplugged with this object.
class PseudoTerminal {
 public:
  PseudoTerminal() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    std::array<char, 64> name{};
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0 ||
        ptsname_r(master_, name.data(), name.size()) != 0) {
      throw std::runtime_error("no pseudo terminal can be made");
    }
    path_ = name.data();
  }
  ~PseudoTerminal() { unplug(); }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

  // Waits for so many bytes; fewer if they do not come.
  [[nodiscard]] std::vector<std::uint8_t> read(std::size_t wanted) const {
    std::vector<std::uint8_t> bytes(wanted);
    std::size_t size = 0;
    for (pollfd waited{master_, POLLIN, 0}; size < wanted && poll(&waited, 1, 10'000) == 1;) {
      const ssize_t count = ::read(master_, bytes.data() + size, wanted - size);
      if (count <= 0) break;
      size += static_cast<std::size_t>(count);
    }
    bytes.resize(size);
    return bytes;
  }
  // Has anything come that was not read?
  [[nodiscard]] bool has_bytes() const {
    pollfd asked{master_, POLLIN, 0};
    return poll(&asked, 1, 0) == 1 && (asked.revents & POLLIN) != 0;
  }
  void unplug() {
    if (master_ >= 0) close(std::exchange(master_, -1));
  }

 private:
  int master_;
  std::string path_;
};

}  // namespace telehug
