// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "common/clock.hpp"

namespace telehug {

// A connection to 127.0.0.1 on which a test says whatever it likes.
class RawBrowser {
 public:
  explicit RawBrowser(std::uint16_t port, int receive_buffer = 0)
      : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer > 0) ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("the test can't connect to the web server");
  }
  ~RawBrowser() { ::close(fd_); }
  RawBrowser(RawBrowser&& other) noexcept : fd_(std::exchange(other.fd_, -1)), received_(std::move(other.received_)) {}
  RawBrowser(const RawBrowser&) = delete;
  RawBrowser& operator=(const RawBrowser&) = delete;
  RawBrowser& operator=(RawBrowser&&) = delete;

  // False if the server does not take it all.
  bool send(std::string_view text) const {
    while (!text.empty()) {
      pollfd there{fd_, POLLOUT, 0};
      if (::poll(&there, 1, 20'000) != 1) return false;
      const ssize_t size = ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (size <= 0) return false;
      text.remove_prefix(static_cast<std::size_t>(size));
    }
    return true;
  }

  void say_no_more() const { ::shutdown(fd_, SHUT_WR); }

  // All that comes until the connection ends, or `end` is in it. What came before the last such call is gone.
  std::string read_until(std::string_view end) {
    for (;;) {
      const auto found = received_.find(end);
      if (!end.empty() && found != std::string::npos) {
        std::string all = received_.substr(0, found + end.size());
        received_.erase(0, all.size());
        return all;
      }
      if (!receive()) return std::exchange(received_, {});
    }
  }
  std::string read_to_the_end() { return read_until(""); }

  // One answer with a Content-Length.
  std::string read_answer() {
    std::string head = read_until("\r\n\r\n");
    const auto length = head.find("Content-Length: ");
    const std::size_t size = length == std::string::npos ? 0 : std::stoul(head.substr(length + 16));
    while (received_.size() < size && receive()) {
    }
    head += received_.substr(0, size);
    received_.erase(0, size);
    return head;
  }

 private:
  bool receive() {
    pollfd there{fd_, POLLIN, 0};
    if (::poll(&there, 1, 20'000) != 1) return false;
    std::array<char, 65'536> chunk{};
    const ssize_t size = ::recv(fd_, chunk.data(), chunk.size(), 0);
    if (size <= 0) return false;
    received_.append(chunk.data(), static_cast<std::size_t>(size));
    return true;
  }

  int fd_;
  std::string received_;
};

}  // namespace telehug
