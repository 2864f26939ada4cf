// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>

namespace telehug {

// A connection to a unix socket without any manners: sends what it is told, reads when it is told.
class RawConnection {
 public:
  explicit RawConnection(const std::filesystem::path& path) : fd_(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
    connected_ = connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawConnection() { close(fd_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  [[nodiscard]] bool connected() const noexcept { return connected_; }

  // False when the other end has closed.
  bool send(std::string_view text) {
    while (!text.empty()) {
      const ssize_t size = ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL);
      if (size < 0) return false;
      text.remove_prefix(static_cast<std::size_t>(size));
    }
    return true;
  }

  // The next line without its end; nothing when the connection is closed. Fails loudly rather than hang.
  std::optional<std::string> line() {
    for (;;) {
      if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
        std::string text = received_.substr(0, end);
        received_.erase(0, end + 1);
        return text;
      }
      pollfd descriptor{fd_, POLLIN, 0};
      if (poll(&descriptor, 1, 20'000) <= 0) return "TIMEOUT";
      std::array<char, 65536> chunk;
      const ssize_t size = recv(fd_, chunk.data(), chunk.size(), 0);
      if (size <= 0) return std::nullopt;
      received_.append(chunk.data(), static_cast<std::size_t>(size));
    }
  }

  [[nodiscard]] bool closed() {
    const auto text = line();
    return !text;
  }

 private:
  int fd_;
  bool connected_ = false;
  std::string received_;
};

}  // namespace telehug
