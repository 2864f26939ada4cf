// SPDX-License-Identifier: Apache-2.0
#include "link/serial_link.hpp"

#include <algorithm>
#include <array>

namespace telehug {
namespace {

// More than one frame waiting in the kernel means that the wire is slower than we talk.
constexpr std::size_t backlog_bytes = protocol::encoded_max_bytes;

}  // namespace

SerialLink::SerialLink(std::string path, unsigned baud) : path_(std::move(path)), baud_(baud) {
  status_.device = path_;
  status_.problem = "not opened yet";
}

void SerialLink::poll(Timestamp now) {
  if (!port_) {
    if (now < retry_at_) return;
    open(now);
  }
  read(now);
  write(now);
  refresh_status();
}

bool SerialLink::send(const MotorCommands& commands, Timestamp now) {
  const bool taken = session_.send(commands, now);
  write(now);
  refresh_status();
  return taken && port_;
}

bool SerialLink::heat(const HeaterCommands& commands, Timestamp now) {
  const bool taken = session_.heat(commands, now);
  write(now);
  refresh_status();
  return taken && port_;
}

void SerialLink::stop_all(Timestamp now) {
  session_.stop_all();
  write(now);
  refresh_status();
}

void SerialLink::open(Timestamp now) {
  auto port = SerialPort::open(path_, baud_);
  if (!port) return lose(port.error().message, now);
  port_.emplace(std::move(port).value());
  leaving_.clear();
  session_.connected(now);
}

void SerialLink::lose(std::string problem, Timestamp now) {
  port_.reset();
  session_.disconnected();
  status_.problem = std::move(problem);
  retry_at_ = now + retry_pause_;
  retry_pause_ = std::min(retry_pause_ * 2, retry_longest);
}

void SerialLink::read(Timestamp now) {
  std::array<std::uint8_t, 256> buffer{};
  while (port_) {
    const auto count = port_->read(buffer);
    if (!count) return lose("the connection to " + path_ + " is lost: plug the jacket in again", now);
    if (*count == 0) return;
    session_.receive(std::span(buffer).first(*count), now);
    if (*count < buffer.size()) return;  // a jacket that never stops talking must not keep us here
  }
}

void SerialLink::write(Timestamp now) {
  while (port_) {
    if (leaving_.empty()) leaving_ = session_.next_frame(now, port_->unsent() > backlog_bytes);
    if (leaving_.empty()) return;
    const auto count = port_->write({leaving_.data(), leaving_.size()});
    if (!count) return lose("the connection to " + path_ + " is lost: plug the jacket in again", now);
    if (*count == 0) return;
    leaving_.erase(leaving_.begin(), leaving_.begin() + static_cast<std::ptrdiff_t>(*count));
  }
}

void SerialLink::refresh_status() {
  const std::string problem = port_ ? session_.status().problem : status_.problem;
  status_ = session_.status();
  status_.device = path_;
  status_.problem = problem;
  if (session_.armed()) retry_pause_ = retry_first;
}

}  // namespace telehug
