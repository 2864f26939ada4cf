// SPDX-License-Identifier: Apache-2.0
#include "doubles/wire_between.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace telehug {
namespace {

void require(bool done, const char* what) {
  if (!done) throw std::system_error(errno, std::generic_category(), what);
}

void make_raw(int fd) {
  termios settings{};
  require(tcgetattr(fd, &settings) == 0, "tcgetattr");
  cfmakeraw(&settings);
  require(tcsetattr(fd, TCSANOW, &settings) == 0, "tcsetattr");
}

void write_all(int fd, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written <= 0) return;  // nobody is there
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void close_and_forget(int& fd) {
  if (fd >= 0) close(fd);
  fd = -1;
}

}  // namespace

WireBetween::WireBetween(std::filesystem::path daemon_side, const std::filesystem::path& jacket, Pass pass)
    : link_(std::move(daemon_side)),
      jacket_(::open(jacket.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)),
      pass_(std::move(pass)) {
  require(jacket_ >= 0, "open the simulator's terminal");
  make_raw(jacket_);
  plug_in();
  thread_ = std::thread([this] { carry(); });
}

WireBetween::~WireBetween() {
  ending_ = true;
  thread_.join();
  unplug();
  close_and_forget(spare_);
  close(jacket_);
}

void WireBetween::set_pass(Pass pass) {
  const std::lock_guard lock(mutex_);
  pass_ = std::move(pass);
}

void WireBetween::unplug() {
  const std::lock_guard lock(mutex_);
  close_and_forget(daemon_);
  std::swap(slave_, spare_);
  close_and_forget(slave_);
  std::error_code ignored;
  std::filesystem::remove(link_, ignored);
}

void WireBetween::plug_in() {
  const std::lock_guard lock(mutex_);
  std::array<char, 128> name{};
  require(openpty(&daemon_, &slave_, name.data(), nullptr, nullptr) == 0, "openpty");
  // A program that is started later would keep it open.
  for (const int fd : {daemon_, slave_})
    fcntl(fd, F_SETFD, FD_CLOEXEC);
  make_raw(slave_);
  std::filesystem::create_symlink(name.data(), link_);
}

std::vector<std::uint8_t> WireBetween::unchanged(Way /*way*/, std::span<const std::uint8_t> bytes, Timestamp /*time*/) {
  return {bytes.begin(), bytes.end()};
}

void WireBetween::carry() {
  while (!ending_) {
    std::array<pollfd, 2> ends{{{-1, POLLIN, 0}, {jacket_, POLLIN, 0}}};
    {
      const std::lock_guard lock(mutex_);
      ends[0].fd = daemon_;
    }
    if (poll(ends.data(), ends.size(), 20) <= 0) continue;
    if ((ends[0].revents & POLLIN) != 0) carry_from(Way::to_jacket);
    if ((ends[1].revents & POLLIN) != 0) carry_from(Way::to_daemon);
  }
}

void WireBetween::carry_from(Way way) {
  const std::lock_guard lock(mutex_);
  std::array<std::uint8_t, 256> bytes{};
  const Timestamp time = SteadyClock().now();
  const ssize_t count = ::read(way == Way::to_jacket ? daemon_ : jacket_, bytes.data(), bytes.size());
  if (count <= 0) return;
  const auto passed = pass_(way, std::span(bytes).first(static_cast<std::size_t>(count)), time);
  write_all(way == Way::to_jacket ? jacket_ : daemon_, passed);
}

}  // namespace telehug
