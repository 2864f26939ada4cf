// SPDX-License-Identifier: Apache-2.0
#include "wire/serial_port.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <linux/serial.h>
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

// USB adapters hold answers back for 16 ms to send them together; drivers that can't be told otherwise are none the
// worse.
void ask_for_low_latency(int fd) {
  serial_struct settings{};
  if (ioctl(fd, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= static_cast<int>(ASYNC_LOW_LATENCY);
  ioctl(fd, TIOCSSERIAL, &settings);
}

// The kernel gives these names in the order of plugging.
bool name_changes(const std::string& path) {
  return path.starts_with("/dev/ttyUSB") || path.starts_with("/dev/ttyACM");
}

}  // namespace

Result<Wire> open_serial_port(const std::string& path, unsigned baud) {
  const auto speed = speed_code(baud);
  if (!speed) {
    return Error{
        fmt::format("{} baud for {} is not a speed that serial ports have: the jacket's is 57600", baud, path)};
  }
  const int fd = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return cannot("open", path, errno);
  Wire port(fd);

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
  ask_for_low_latency(fd);
  tcflush(fd, TCIOFLUSH);
  return port;
}

SerialOpener::SerialOpener(std::string path, unsigned baud, std::filesystem::path by_id)
    : any_(path == "auto"), device_(std::move(path)), baud_(baud), by_id_(std::move(by_id)) {
  if (any_) device_ = "serial:auto";
}

std::optional<Result<Wire>> SerialOpener::open(Timestamp /*now*/) {
  if (any_) {
    auto only = only_serial_device(by_id_);
    if (!only) return only.error();
    device_ = *std::move(only);
  }
  auto port = open_serial_port(device_, baud_);
  if (!port) return Error{port.error().message + better_name()};
  return port;
}

// What to call it instead of a name that changes.
std::string SerialOpener::better_name() const {
  if (any_ || !name_changes(device_)) return "";
  const auto devices = serial_devices(by_id_);
  if (devices.empty()) return "";
  return fmt::format("; {} may be another device each time, serial:{} stays one and the same", device_,
                     fmt::join(devices, " or serial:"));
}

}  // namespace telehug
