// SPDX-License-Identifier: Apache-2.0
#include "simulator/pty_bridge.hpp"

#include <fcntl.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace telehug {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

PtyBridge::PtyBridge(std::filesystem::path link) : link_(std::move(link)) {
  termios raw{};
  cfmakeraw(&raw);
  raw.c_cflag |= CREAD | CLOCAL;
  std::array<char, 128> name{};
  if (openpty(&master_, &slave_, name.data(), &raw, nullptr) != 0) fail("can't make a pseudo terminal");
  path_ = name.data();
  for (const int fd : {master_, slave_}) {
    fcntl(fd, F_SETFD, FD_CLOEXEC);
    fcntl(fd, F_SETFL, O_RDWR | O_NONBLOCK);
  }
  if (link_.empty()) return;
  const std::filesystem::path draft = link_.string() + "." + std::to_string(getpid());
  std::filesystem::create_symlink(path_, draft);
  std::filesystem::rename(draft, link_);
}

PtyBridge::~PtyBridge() {
  std::error_code ignored;
  if (!link_.empty() && std::filesystem::read_symlink(link_, ignored) == path_) {
    std::filesystem::remove(link_, ignored);
  }
  close(slave_);
  close(master_);
}

std::vector<std::uint8_t> PtyBridge::read() {
  std::array<std::uint8_t, 256> buffer{};
  const ssize_t count = ::read(master_, buffer.data(), buffer.size());
  if (count <= 0) return {};
  return {buffer.begin(), buffer.begin() + count};
}

void PtyBridge::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(master_, bytes.data(), bytes.size());
    if (count <= 0) return;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

}  // namespace telehug
