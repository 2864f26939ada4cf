// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace telehug {

// Two connected sockets: one for the code under test to own, one for the test. Neither waits.
class SocketPair {
 public:
  SocketPair() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      throw std::runtime_error("no pair of sockets can be made");
    }
    given_ = ends[0];
    own_ = ends[1];
  }
  ~SocketPair() {
    close_own();
    if (given_ >= 0) close(given_);
  }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;

  // The end to give away, once.
  [[nodiscard]] int give() { return std::exchange(given_, -1); }

  void write(std::span<const std::uint8_t> bytes) const {
    if (::write(own_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("the socket takes no more");
    }
  }
  // All that has come.
  [[nodiscard]] std::vector<std::uint8_t> read() const {
    std::vector<std::uint8_t> bytes;
    std::array<std::uint8_t, 4096> part{};
    for (ssize_t count = 0; (count = ::read(own_, part.data(), part.size())) > 0;)
      bytes.insert(bytes.end(), part.begin(), part.begin() + count);
    return bytes;
  }
  // Likewise, for nobody.
  void drain() const {
    std::array<std::uint8_t, 4096> part{};
    while (::read(own_, part.data(), part.size()) > 0) {
    }
  }
  // Whether the given end has been closed.
  [[nodiscard]] bool is_closed() const {
    std::uint8_t byte = 0;
    return recv(own_, &byte, 1, MSG_PEEK) == 0;
  }
  void close_own() {
    if (own_ >= 0) close(std::exchange(own_, -1));
  }

 private:
  int given_ = -1;
  int own_ = -1;
};

}  // namespace telehug
