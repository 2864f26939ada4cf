// SPDX-License-Identifier: Apache-2.0
#include "local_touch/tuio_sender.hpp"

#include <fmt/core.h>
#include <lo/lo.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace telehug {
namespace {

constexpr const char* profile = "/tuio/2Dcur";

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "localhost";
}

lo_message add_message(lo_bundle bundle, const char* kind) {
  lo_message message = lo_message_new();
  lo_message_add_string(message, kind);
  lo_bundle_add_message(bundle, profile, message);
  return message;
}

}  // namespace

struct TuioSender::Address {
  explicit Address(lo_address given) : lo(given) {}
  ~Address() {
    if (lo != nullptr) lo_address_free(lo);
  }
  Address(const Address&) = delete;
  Address& operator=(const Address&) = delete;
  lo_address lo;
};

TuioSender::TuioSender(TuioSettings settings) : settings_(std::move(settings)), source_("telehug@" + host_name()) {}

TuioSender::~TuioSender() {
  close();
}

Status TuioSender::open(const ScreenSize& screen) {
  close();
  screen_ = screen;
  address_ = std::make_unique<Address>(
      lo_address_new_with_proto(LO_UDP, settings_.host.c_str(), std::to_string(settings_.port).c_str()));
  if (address_->lo == nullptr) return Error{fmt::format("{} is no address that TUIO can be sent to", name())};
  cursors_.clear();
  return send_bundle(++frame_);
}

void TuioSender::close() {
  if (!address_) return;
  if (!cursors_.empty()) {
    cursors_.clear();
    (void)send_bundle(++frame_);
  }
  address_.reset();
}

std::string TuioSender::name() const {
  return fmt::format("TUIO {}:{}", settings_.host, settings_.port);
}

Status TuioSender::send(const ContactStates& contacts, Timestamp time) {
  const bool idle = cursors_.empty();
  Cursors now;
  for (const ContactState& contact : contacts) {
    if (contact.phase != Phase::up) now.push_back(cursor_of(contact, time));
  }
  cursors_ = now;
  const bool quiet = idle && cursors_.empty();
  if (quiet && sent_ && time >= *sent_ && time - *sent_ < idle_interval) return Done{};
  sent_ = time;
  if (frame_ == std::numeric_limits<std::int32_t>::max()) frame_ = 0;
  return send_bundle(quiet ? -1 : ++frame_);
}

TuioSender::Cursor TuioSender::cursor_of(const ContactState& contact, Timestamp time) const {
  Cursor cursor{.contact = contact.id,
                .x = static_cast<float>(std::clamp(contact.screen.x_mm / screen_.width_mm, 0.0, 1.0)),
                .y = static_cast<float>(std::clamp(contact.screen.y_mm / screen_.height_mm, 0.0, 1.0)),
                .time = time};
  const auto before = std::ranges::find(cursors_, contact.id, &Cursor::contact);
  const auto seconds = before == cursors_.end() ? 0 : std::chrono::duration<float>(time - before->time).count();
  if (seconds > 0) {
    cursor.x_speed = (cursor.x - before->x) / seconds;
    cursor.y_speed = (cursor.y - before->y) / seconds;
    const float speed = std::hypot(cursor.x_speed, cursor.y_speed);
    cursor.acceleration = (speed - std::hypot(before->x_speed, before->y_speed)) / seconds;
  }
  return cursor;
}

Status TuioSender::send_bundle(std::int32_t frame) {
  lo_bundle bundle = lo_bundle_new(LO_TT_IMMEDIATE);
  lo_message_add_string(add_message(bundle, "source"), source_.c_str());
  lo_message alive = add_message(bundle, "alive");
  for (const Cursor& cursor : cursors_)
    lo_message_add_int32(alive, static_cast<std::int32_t>(cursor.contact));
  for (const Cursor& cursor : cursors_) {
    lo_message set = add_message(bundle, "set");
    lo_message_add_int32(set, static_cast<std::int32_t>(cursor.contact));
    for (const float value : {cursor.x, cursor.y, cursor.x_speed, cursor.y_speed, cursor.acceleration})
      lo_message_add_float(set, value);
  }
  lo_message_add_int32(add_message(bundle, "fseq"), frame);
  const int sent = lo_send_bundle(address_->lo, bundle);
  lo_bundle_free_recursive(bundle);
  if (sent >= 0) return Done{};
  return Error{fmt::format("{} can't be sent to ({}); check [local_touch] tuio_host and the network", name(),
                           lo_address_errstr(address_->lo))};
}

}  // namespace telehug
