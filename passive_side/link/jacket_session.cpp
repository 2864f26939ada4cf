// SPDX-License-Identifier: Apache-2.0
#include "link/jacket_session.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "link/jacket_telemetry.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using protocol::NackReason;

constexpr Duration duration_unit = 10ms;
constexpr auto drive_max_units = protocol::drive_max_ms / 10;

// Rounded down: a motor never runs longer than it was asked to.
std::uint8_t duration_units(Duration duration) {
  return static_cast<std::uint8_t>(std::clamp<Duration::rep>(duration / duration_unit, 0, drive_max_units));
}

// Rounded down likewise; the small addend is for numbers such as 37.9 that binary fractions miss from below.
std::uint16_t decidegrees(double celsius) {
  return static_cast<std::uint16_t>(std::floor(celsius * 10 + 1e-6));
}

bool may_be_asked_for(double celsius) {
  return celsius >= 0 && celsius * 10 <= protocol::heat_max_decidegrees;
}  // false for NaN

}  // namespace

void JacketSession::connected(Timestamp now) {
  decoder_.reset();
  line_is_fresh_ = true;
  stop_ = Stop::wanted;
  greet(now);
}

void JacketSession::disconnected() {
  phase_ = Phase::closed;
  status_.state = LinkState::absent;
  status_.telemetry.reset();
  forget_wanted();
}

void JacketSession::forget_wanted() {
  wanted_.reset();
  wanted_heat_ = {};
}

void JacketSession::greet(Timestamp now) {
  phase_ = Phase::greeting;
  status_.state = LinkState::connecting;
  status_.problem = "waiting for the jacket's answer";
  refused_ = false;
  // Tells the answers of this greeting from those that an earlier one has left on the wire.
  nonce_ = static_cast<std::uint16_t>(nonce_ + 1 + (to_ns(now) & 0xFF));
  greeting_since_ = now;
  next_hello_ = now;
  forget_wanted();
  running_ = {};
  heating_ = {};
}

void JacketSession::receive(std::span<const std::uint8_t> bytes, Timestamp now) {
  for (const std::uint8_t byte : bytes) {
    if (const auto frame = decoder_.push(byte)) on_frame(*frame, now);
  }
  status_.malformed_frames = decoder_.malformed() + unexpected_frames_;
}

void JacketSession::note_answer(Timestamp now) {
  last_heard_ = now;
  unanswered_since_.reset();
}

void JacketSession::on_frame(const Frame& frame, Timestamp now) {
  if (phase_ == Phase::closed) return;
  ++status_.frames_received;
  if (const auto caps = parse_caps(frame)) {
    note_answer(now);
    if (phase_ == Phase::greeting && caps->nonce == nonce_) on_caps(*caps, now);
  } else if (frame.type == FrameType::ack && frame.payload.size() == 1) {
    note_answer(now);
    if (stop_ == Stop::unacknowledged && frame.sequence == stop_sequence_) stop_ = Stop::none;
  } else if (frame.type == FrameType::nack && frame.payload.size() == 2) {
    note_answer(now);
    on_nack(frame, now);
  } else if (auto telemetry = read_telemetry(frame, temperatures_, now)) {
    note_answer(now);
    status_.telemetry = *telemetry;
  } else {
    ++unexpected_frames_;
  }
}

void JacketSession::on_caps(const protocol::Caps& caps, Timestamp now) {
  status_.firmware_version = caps.firmware;
  if (caps.protocol != protocol::version || caps.motors == 0 || caps.motors > protocol::motor_count ||
      caps.heaters > protocol::heater_count || caps.temperatures > protocol::heater_count) {
    return refuse(fmt::format(
        "the jacket answers with protocol {}, {} motors, {} heaters and {} temperatures, which telehug does "
        "not know: update its firmware",
        caps.protocol, caps.motors, caps.heaters, caps.temperatures));
  }
  status_.motor_count = caps.motors;
  status_.heater_count = std::min(caps.heaters, caps.temperatures);
  temperatures_ = caps.temperatures;
  status_.telemetry.reset();
  next_status_ = now;
  status_.problem.clear();
  status_.state = LinkState::armed;
  phase_ = Phase::armed;
  if (armed_before_) ++status_.reconnects;
  armed_before_ = true;
}

void JacketSession::on_nack(const Frame& frame, Timestamp now) {
  ++status_.nacks;
  switch (static_cast<NackReason>(frame.payload[1])) {
    case NackReason::unarmed:
      if (phase_ == Phase::armed) greet(now);
      break;
    case NackReason::bad_version:
      refuse("the jacket's firmware speaks another version of the protocol: update it");
      break;
    default:
      break;
  }
}

// Goes on greeting, in case somebody plugs in another jacket, but keeps telling why there is none.
void JacketSession::refuse(std::string problem) {
  refused_ = true;
  status_.problem = std::move(problem);
}

bool JacketSession::send(const MotorCommands& commands, Timestamp now) {
  if (phase_ != Phase::armed) return false;
  Drives state{};
  bool drives_any = false;
  for (const MotorCommand& command : commands) {
    if (command.channel >= status_.motor_count || command.intensity == 0 || duration_units(command.duration) == 0) {
      continue;
    }
    state.at(command.channel) = {command.intensity, now + command.duration};
    drives_any = true;
  }
  if (drives_any && stop_ == Stop::unacknowledged) stop_ = Stop::none;  // it has left; a repetition would end this
  wanted_ = state;
  return true;
}

bool JacketSession::heat(const HeaterCommands& commands, Timestamp now) {
  if (phase_ != Phase::armed || status_.heater_count == 0) return false;
  for (const HeaterCommand& command : commands)
    if (!may_be_asked_for(command.celsius)) return false;
  for (const HeaterCommand& command : commands) {
    if (command.heater >= status_.heater_count) continue;
    const bool warms = decidegrees(command.celsius) > 0 && duration_units(command.duration) > 0;
    wanted_heat_.at(command.heater) =
        warms ? Heat{decidegrees(command.celsius), now + command.duration} : Heat{.decidegrees = 0, .end = now};
    if (warms && stop_ == Stop::unacknowledged) stop_ = Stop::none;  // as for motors
  }
  return true;
}

void JacketSession::stop_all() {
  forget_wanted();
  if (phase_ != Phase::closed) stop_ = Stop::wanted;
}

EncodedFrame JacketSession::next_frame(Timestamp now, bool has_backlog) {
  if (phase_ == Phase::closed) return {};
  if (stop_ == Stop::wanted) return make_stop(now);
  if (phase_ == Phase::armed && now - last_heard_ > silence_max) greet(now);
  if (has_backlog) return {};
  if (phase_ == Phase::greeting) {
    if (!refused_ && now - greeting_since_ > hello_patience) {
      status_.problem = "the jacket does not answer: check that it is switched on and that its firmware is telehug's";
    }
    return now >= next_hello_ ? make_hello(now) : EncodedFrame{};
  }
  if (stop_ == Stop::unacknowledged && now - stop_sent_ >= stop_repeat) return make_stop(now);
  if (EncodedFrame frame = make_drive(now); !frame.empty()) return frame;
  if (now >= next_status_) {
    next_status_ = now + status_interval;
    return make_frame(FrameType::status, {}, now);
  }
  if (now - last_sent_ >= keep_interval) return make_frame(FrameType::keep, {}, now);
  return {};
}

EncodedFrame JacketSession::make_frame(FrameType type, const FramePayload& payload, Timestamp now) {
  ++status_.frames_sent;
  if (!unanswered_since_) unanswered_since_ = now;
  last_sent_ = now;
  return encode({type, ++sequence_, payload});
}

EncodedFrame JacketSession::make_stop(Timestamp now) {
  EncodedFrame frame = make_frame(FrameType::stop_all, {}, now);
  if (line_is_fresh_) frame.insert(frame.begin(), 0);  // ends whatever a bootloader or an earlier host left on the line
  line_is_fresh_ = false;
  stop_ = Stop::unacknowledged;
  stop_sequence_ = sequence_;
  stop_sent_ = now;
  running_ = {};
  heating_ = {};
  return frame;
}

EncodedFrame JacketSession::make_hello(Timestamp now) {
  next_hello_ = now + hello_interval;
  return make_frame(FrameType::hello,
                    {protocol::version, protocol::version, static_cast<std::uint8_t>(nonce_ & 0xFF),
                     static_cast<std::uint8_t>(nonce_ >> 8)},
                    now);
}

bool JacketSession::wants_less_drive(Timestamp now) const {
  if (!wanted_) return false;
  for (std::size_t channel = 0; channel < running_.size(); ++channel) {
    const bool runs = running_.at(channel).end > now;
    if (runs && wanted_->at(channel).intensity < running_.at(channel).intensity) return true;
  }
  return false;
}

bool JacketSession::wants_less_heat(Timestamp now) const {
  for (std::size_t heater = 0; heater < heating_.size(); ++heater) {
    const auto& wanted = wanted_heat_.at(heater);
    const bool runs = heating_.at(heater).end > now;
    if (runs && wanted && wanted->decidegrees < heating_.at(heater).decidegrees) return true;
  }
  return false;
}

bool JacketSession::wants_no_drive() const {
  return wanted_ && std::ranges::none_of(*wanted_, [](const Drive& drive) { return drive.intensity != 0; });
}

bool JacketSession::wants_heat() const {
  return std::ranges::any_of(wanted_heat_, [](const auto& heat) { return heat.has_value(); });
}

bool JacketSession::heats(Timestamp now) const {
  return std::ranges::any_of(heating_, [now](const Heat& heat) { return heat.end > now; });
}

// What turns something down or off goes at once; what only drives waits for its turn.
EncodedFrame JacketSession::make_drive(Timestamp now) {
  const bool silent = unanswered_since_ && now - *unanswered_since_ >= answer_patience;
  if (silent) return wants_no_drive() ? make_set(now) : EncodedFrame{};
  const bool lowers_drive = wants_less_drive(now) && pace_.may_lower(now);
  const bool lowers_heat = wants_less_heat(now) && pace_.may_lower(now);
  const bool turn = pace_.may_drive(now);
  const auto set_first = [&] { return lowers_drive || (!lowers_heat && !(heat_is_next_ && wants_heat())); };
  if (wanted_ && (lowers_drive || turn) && set_first()) {
    if (EncodedFrame frame = make_set(now); !frame.empty()) return frame;
  }
  if (wants_heat() && (lowers_heat || turn)) return make_heat(now);
  return {};
}

EncodedFrame JacketSession::make_set(Timestamp now) {
  FramePayload payload;
  bool drives_any = false;
  for (std::size_t channel = 0; channel < running_.size(); ++channel) {
    const Drive& wanted = wanted_->at(channel);
    Drive& running = running_.at(channel);
    const std::uint8_t units = wanted.intensity == 0 ? std::uint8_t{0} : duration_units(wanted.end - now);
    if (units == 0 && running.end <= now) continue;
    const std::uint8_t intensity = units == 0 ? std::uint8_t{0} : wanted.intensity;
    for (const std::uint8_t byte : {static_cast<std::uint8_t>(channel), intensity, units})
      payload.push_back(byte);
    running = {intensity, now + units * duration_unit};
    drives_any = drives_any || units != 0;
  }
  wanted_.reset();
  if (payload.empty()) return {};
  if (!drives_any && !heats(now) && !wants_heat()) return make_stop(now);
  pace_.sent(now);
  heat_is_next_ = true;
  return make_frame(FrameType::set, payload, now);
}

EncodedFrame JacketSession::make_heat(Timestamp now) {
  FramePayload payload;
  for (std::size_t heater = 0; heater < heating_.size(); ++heater) {
    const auto wanted = std::exchange(wanted_heat_.at(heater), std::nullopt);
    if (!wanted) continue;
    Heat& heating = heating_.at(heater);
    const std::uint8_t units = duration_units(wanted->end - now);
    if (units == 0 && heating.end <= now) continue;
    const std::uint16_t target = units == 0 ? std::uint16_t{0} : wanted->decidegrees;
    for (const int byte : {static_cast<int>(heater), target & 0xFF, target >> 8, static_cast<int>(units)})
      payload.push_back(static_cast<std::uint8_t>(byte));
    heating = {target, now + units * duration_unit};
  }
  if (payload.empty()) return {};
  pace_.sent(now);
  heat_is_next_ = false;
  return make_frame(FrameType::heat, payload, now);
}

}  // namespace telehug
