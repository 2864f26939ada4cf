// SPDX-License-Identifier: Apache-2.0
#include "link/serial_port.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace telehug {
namespace {

struct Speed {
  unsigned baud;
  speed_t code;
};
constexpr std::array<Speed, 9> speeds{{{9600, B9600},
                                       {19200, B19200},
                                       {38400, B38400},
                                       {57600, B57600},
                                       {115200, B115200},
                                       {230400, B230400},
                                       {460800, B460800},
                                       {500000, B500000},
                                       {1000000, B1000000}}};

std::optional<speed_t> speed_code(unsigned baud) {
  for (const Speed& speed : speeds) {
    if (speed.baud == baud) return speed.code;
  }
  return std::nullopt;
}

// Unix98 pseudo terminals have these major numbers (Linux Documentation/admin-guide/devices.txt).
bool is_pseudo_terminal(int fd) {
  struct stat status {};
  return fstat(fd, &status) == 0 && major(status.st_rdev) >= 136 && major(status.st_rdev) <= 143;
}

std::string advice(int error) {
  switch (error) {
    case ENOENT:
      return "plug the jacket in";
    case EACCES:
      return "add this user to the group dialout";
    case EBUSY:
      return "close the program that uses it";
    default:
      return "check the jacket's cable and the path in the config";
  }
}

Error cannot(const std::string& what, const std::string& path, int error) {
  return {fmt::format("can't {} {}: {}; {}", what, path, std::strerror(error), advice(error))};
}

}  // namespace

Result<SerialPort> SerialPort::open(const std::string& path, unsigned baud) {
  const auto speed = speed_code(baud);
  if (!speed) {
    return Error{
        fmt::format("{} baud for {} is not a speed that serial ports have: the jacket's is 57600", baud, path)};
  }
  const int fd = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return cannot("open", path, errno);
  SerialPort port(fd);

  termios settings{};
  if (tcgetattr(fd, &settings) != 0) {
    return Error{fmt::format("{} is not a serial port: name the jacket's device in the config", path)};
  }
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    return cannot("lock", path, errno == EWOULDBLOCK ? EBUSY : errno);
  }
  // A pseudo terminal would keep this mark after a crash of ours and lock out our next start.
  if (!is_pseudo_terminal(fd)) ioctl(fd, TIOCEXCL);

  cfmakeraw(&settings);
  settings.c_cflag |= CREAD | CLOCAL;
  // Closing must not drop DTR: on an Arduino that is a reset at the next open.
  settings.c_cflag &= ~(static_cast<tcflag_t>(HUPCL) | static_cast<tcflag_t>(CRTSCTS));
  cfsetspeed(&settings, *speed);
  if (tcsetattr(fd, TCSANOW, &settings) != 0) return cannot("set up", path, errno);
  tcflush(fd, TCIOFLUSH);
  return port;
}

SerialPort::SerialPort(SerialPort&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
SerialPort& SerialPort::operator=(SerialPort&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}
SerialPort::~SerialPort() {
  if (fd_ >= 0) close(fd_);
}

std::optional<std::size_t> SerialPort::read(std::span<std::uint8_t> into) {
  const ssize_t count = ::read(fd_, into.data(), into.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  return std::nullopt;  // 0 from a terminal without VMIN = 0: hung up
}

std::optional<std::size_t> SerialPort::write(std::span<const std::uint8_t> bytes) {
  const ssize_t count = ::write(fd_, bytes.data(), bytes.size());
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR) return 0;
  return std::nullopt;
}

std::size_t SerialPort::unsent() const {
  int count = 0;
  return ioctl(fd_, TIOCOUTQ, &count) == 0 && count > 0 ? static_cast<std::size_t>(count) : 0;
}

}  // namespace telehug
