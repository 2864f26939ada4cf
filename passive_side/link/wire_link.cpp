// SPDX-License-Identifier: Apache-2.0
#include "link/wire_link.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace telehug {
namespace {

constexpr int most_parts = 16;  // of what has come: a jacket that never stops talking must not keep us

}  // namespace

WireLink::WireLink(std::unique_ptr<WireOpener> opener, std::unique_ptr<Conversation> conversation)
    : opener_(std::move(opener)), conversation_(std::move(conversation)), problem_("not opened yet") {
  refresh_status();
}

void WireLink::poll(Timestamp now) {
  if (!wire_ && now >= retry_at_) open(now);
  read(now);
  write(now);
  refresh_status();
}

bool WireLink::send(const MotorCommands& commands, Timestamp now) {
  const bool taken = conversation_->send(commands, now);
  write(now);
  refresh_status();
  return taken && wire_;
}

bool WireLink::heat(const HeaterCommands& commands, Timestamp now) {
  const bool taken = conversation_->heat(commands, now);
  write(now);
  refresh_status();
  return taken && wire_;
}

void WireLink::stop_all(Timestamp now) {
  conversation_->stop_all();
  write(now);
  refresh_status();
}

void WireLink::open(Timestamp now) {
  auto wire = opener_->open(now);
  if (!wire) {
    problem_ = opener_->progress();
    return;
  }
  if (!*wire) return lose(wire->error().message, now);
  wire_.emplace(std::move(*wire).value());
  leaving_.clear();
  conversation_->connected(now);
}

void WireLink::lose(std::string problem, Timestamp now) {
  wire_.reset();
  conversation_->disconnected();
  problem_ = std::move(problem);
  retry_at_ = now + retry_pause_;
  retry_pause_ = std::min(retry_pause_ * 2, retry_longest);
}

void WireLink::lose_wire(Timestamp now) {
  lose(fmt::format("the connection to {} is lost: {}", opener_->device(), opener_->lost_advice()), now);
}

void WireLink::read(Timestamp now) {
  std::array<std::uint8_t, 256> buffer{};
  for (int part = 0; wire_ && part < most_parts; ++part) {
    const auto count = wire_->read(buffer);
    if (!count) return lose_wire(now);
    if (*count == 0) return;
    conversation_->receive(std::span(buffer).first(*count), now);
    if (*count < buffer.size()) return;
  }
}

void WireLink::write(Timestamp now) {
  while (wire_) {
    if (leaving_.empty()) leaving_ = conversation_->next_frame(now, wire_->has_backlog());
    if (leaving_.empty()) return;
    const auto count = wire_->write({leaving_.data(), leaving_.size()});
    if (!count) return lose_wire(now);
    if (*count == 0) return;
    leaving_.erase(leaving_.begin(), leaving_.begin() + static_cast<std::ptrdiff_t>(*count));
  }
}

void WireLink::refresh_status() {
  status_ = conversation_->status();
  status_.device = opener_->device();
  if (!wire_) status_.problem = problem_;
  if (status_.state == LinkState::armed) retry_pause_ = retry_first;
}

}  // namespace telehug
