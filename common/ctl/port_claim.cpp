// SPDX-License-Identifier: Apache-2.0
#include "ctl/port_claim.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include "ctl/plain_text.hpp"

namespace telehug {
namespace {

// The process whose flock() is on the file: /proc/locks, proc(5).
std::optional<int> holder_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    int pid = 0;
    unsigned major_number = 0;
    unsigned minor_number = 0;
    unsigned long inode = 0;
    if (std::sscanf(line.c_str(), "%*d: FLOCK %*s WRITE %d %x:%x:%lu", &pid, &major_number, &minor_number, &inode) ==
            4 &&
        pid > 0 && inode == status.st_ino && makedev(major_number, minor_number) == status.st_dev)
      return pid;
  }
  return std::nullopt;
}

Error in_use(const std::string& path) {
  const auto pid = holder_of(path);
  if (!pid) return {fmt::format("another program uses {}: end it (telehug-passive by Ctrl+C where it runs)", path)};
  std::string name;
  std::getline(std::ifstream(fmt::format("/proc/{}/comm", *pid)), name);
  return {fmt::format("{} uses {}: end it by `kill {}`, and start it again when the firmware is written",
                      name.empty() ? "another program" : plain_text(name), path, *pid)};
}

Error cannot_open(const std::string& path, int error) {
  switch (error) {
    case ENOENT:
      return {fmt::format("there is no {}: plug the board in, or name its port by --port", path)};
    case EACCES:
      return {fmt::format("this user may not open {}: `sudo adduser $USER dialout`, then log in again", path)};
    case EBUSY:
      return in_use(path);
    default:
      return {fmt::format("can't open {}: {}", path, std::strerror(error))};
  }
}

}  // namespace

Result<PortClaim> PortClaim::take(const std::string& path) {
  const int fd = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return cannot_open(path, errno);
  PortClaim claim(fd);
  termios settings{};
  if (tcgetattr(fd, &settings) != 0) return Error{fmt::format("{} is not a serial port", path)};
  // telehug-passive holds this lock while it has the port.
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) return in_use(path);
  return claim;
}

PortClaim::~PortClaim() {
  if (fd_ >= 0) close(fd_);
}
PortClaim::PortClaim(PortClaim&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
PortClaim& PortClaim::operator=(PortClaim&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

}  // namespace telehug
