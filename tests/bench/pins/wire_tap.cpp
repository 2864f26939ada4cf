// SPDX-License-Identifier: Apache-2.0
#include "bench/pins/wire_tap.hpp"

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

void write_all(int fd, const std::uint8_t* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(fd, bytes, count);
    if (written <= 0) return;  // nobody is there
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

}  // namespace

WireTap::WireTap(const std::filesystem::path& daemon_side, const std::filesystem::path& jacket) : link_(daemon_side) {
  std::array<char, 128> name{};
  require(openpty(&daemon_, &slave_, name.data(), nullptr, nullptr) == 0, "openpty");
  make_raw(slave_);
  jacket_ = ::open(jacket.c_str(), O_RDWR | O_NOCTTY);
  require(jacket_ >= 0, "open the simulator's terminal");
  make_raw(jacket_);
  std::filesystem::create_symlink(name.data(), link_);
  thread_ = std::thread([this] { pass_on(); });
}

WireTap::~WireTap() {
  ending_ = true;
  thread_.join();
  for (const int fd : {daemon_, slave_, jacket_})
    close(fd);
  std::error_code ignored;
  std::filesystem::remove(link_, ignored);
}

std::vector<WrittenSet> WireTap::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(written_, {});
}

void WireTap::pass_on() {
  std::array<std::uint8_t, 256> bytes{};
  while (!ending_) {
    std::array<pollfd, 2> ends{{{daemon_, POLLIN, 0}, {jacket_, POLLIN, 0}}};
    if (poll(ends.data(), ends.size(), 100) <= 0) continue;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if ((ends.at(i).revents & POLLIN) == 0) continue;
      const Timestamp time = SteadyClock().now();
      const ssize_t count = ::read(ends.at(i).fd, bytes.data(), bytes.size());
      if (count <= 0) continue;
      write_all(ends.at(1 - i).fd, bytes.data(), static_cast<std::size_t>(count));
      for (std::size_t at = 0; i == 0 && at < static_cast<std::size_t>(count); ++at)
        note(bytes.at(at), time);
    }
  }
}

void WireTap::note(std::uint8_t byte, Timestamp time) {
  const auto frame = decoder_.push(byte);
  if (!frame || frame->type != protocol::FrameType::set) return;
  WrittenSet set{time, {}};
  for (std::size_t at = 0; at + protocol::set_entry_bytes <= frame->payload.size(); at += protocol::set_entry_bytes)
    if (frame->payload[at] < protocol::motor_count) set.intensity.at(frame->payload[at]) = frame->payload[at + 1];
  const std::lock_guard lock(mutex_);
  written_.push_back(set);
}

}  // namespace telehug
