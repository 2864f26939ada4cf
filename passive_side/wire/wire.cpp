// SPDX-License-Identifier: Apache-2.0
#include "wire/wire.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace telehug {
namespace {

constexpr int backlog_bytes = 64;  // the longest frame
// Sockets count what a frame takes in the kernel's memory: 768 bytes for each of ours.
constexpr int socket_backlog_bytes = 2048;

bool is_socket(int fd) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &size) == 0;
}

}  // namespace

Wire::Wire(int fd) : fd_(fd), is_socket_(is_socket(fd)) {
  fcntl(fd_, F_SETFL, fcntl(fd_, F_GETFL) | O_NONBLOCK);
  // Linux' Bluetooth sockets tell the room that is left (net/bluetooth/af_bluetooth.c), all others what is in the
  // queue.
  if (is_socket_) room_ = queue_count();
}
Wire::Wire(Wire&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), is_socket_(other.is_socket_), room_(other.room_) {}
Wire& Wire::operator=(Wire&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(is_socket_, other.is_socket_);
  std::swap(room_, other.room_);
  return *this;
}
Wire::~Wire() {
  if (fd_ < 0) return;
  if (is_socket_) shutdown(fd_, SHUT_RDWR);  // BlueZ keeps a copy, which would keep it connected
  close(fd_);
}

std::optional<std::size_t> Wire::read(std::span<std::uint8_t> into) {
  const ssize_t count = ::read(fd_, into.data(), into.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  return std::nullopt;  // 0 from a terminal without VMIN = 0: hung up
}

std::optional<std::size_t> Wire::write(std::span<const std::uint8_t> bytes) {
  const ssize_t count =
      is_socket_ ? send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) : ::write(fd_, bytes.data(), bytes.size());
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR) return 0;
  return std::nullopt;
}

bool Wire::has_backlog() const {
  const int count = queue_count();
  if (room_ > 0) return room_ - count > socket_backlog_bytes;
  return count > (is_socket_ ? socket_backlog_bytes : backlog_bytes);
}

int Wire::queue_count() const {
  int count = 0;
  return ioctl(fd_, TIOCOUTQ, &count) == 0 ? count : 0;
}

}  // namespace telehug
