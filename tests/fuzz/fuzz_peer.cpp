// SPDX-License-Identifier: Apache-2.0
//
// What a paired but hostile sender can do with messages that are all valid: any values, any order, any time. Whatever
// it says, no motor runs without its heartbeats, after its stop, beyond the limits, or for longer than 250 ms more.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "dds/validate.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"
#include "doubles/fake_jacket_link.hpp"
#include "fuzz/bytes.hpp"
#include "passive_pipeline.hpp"
#include "peer/heartbeat_exchange.hpp"
#include "peer/peer_monitor.hpp"
#include "peer_link/stop_latch.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

constexpr double strongest = 0.5;

void require(bool holds) {
  if (!holds) std::abort();
}

std::uint64_t sequence(Bytes& bytes) {
  const std::uint8_t small = bytes.byte();
  if (small < 250) return small;
  return small < 253 ? bytes.number<std::uint64_t>() : std::numeric_limits<std::uint64_t>::max() - (255 - small);
}

std::int64_t time_ns(Bytes& bytes, Timestamp now) {
  switch (bytes.byte() % 4) {
    case 0:
      return to_ns(now) + bytes.number<std::int16_t>() * std::int64_t{1'000'000};
    case 1:
      return bytes.number<std::int64_t>() & std::numeric_limits<std::int64_t>::max();
    case 2:
      return std::numeric_limits<std::int64_t>::max();
    default:
      return bytes.byte();
  }
}

double real(Bytes& bytes, double most) {
  return most * bytes.number<std::int16_t>() / std::numeric_limits<std::int16_t>::max();
}

SessionId session(Bytes& bytes) {
  SessionId id = example_session;
  id[0] = "0123"[bytes.byte() % 4];
  return id;
}

Contact contact(Bytes& bytes) {
  Contact made;
  made.id = bytes.byte() % 16U;
  made.phase = static_cast<Phase>(bytes.byte() % 3);
  made.grid = bytes.byte() % 4 != 0 ? GridShape{5, 4} : GridShape{bytes.byte(), bytes.byte()};
  made.box = bytes.byte();
  made.body = {real(bytes, max_body_fh), real(bytes, max_body_fh)};
  made.screen = {real(bytes, max_screen_mm), real(bytes, max_screen_mm)};
  made.speed_mm_s = std::abs(real(bytes, max_speed_mm_s));
  made.strength = std::abs(real(bytes, 1));
  made.gesture = static_cast<Gesture>(bytes.byte() % gesture_count);
  return made;
}

TouchEvent touch(Bytes& bytes, Timestamp now) {
  TouchEvent made;
  made.session = session(bytes);
  made.sequence = sequence(bytes);
  made.frame_time_ns = time_ns(bytes, now);
  made.sent_time_ns = time_ns(bytes, now);
  made.body_map_version = bytes.byte();
  for (std::size_t n = bytes.byte() % (max_contacts + 1); n > 0; --n)
    made.contacts.push_back(contact(bytes));
  for (std::size_t n = bytes.byte() % (max_transitions + 1); n > 0; --n)
    made.transitions.push_back({sequence(bytes), time_ns(bytes, now), contact(bytes)});
  std::ranges::sort(made.transitions, {}, &Transition::event_sequence);
  return made;
}

Heartbeat heartbeat(Bytes& bytes, Timestamp now) {
  return {.session = session(bytes),
          .side = Side::active,
          .sequence = sequence(bytes),
          .sent_time_ns = time_ns(bytes, now),
          .echo_session = bytes.byte() % 4 == 0 ? SessionId{} : other_session,
          .echo_sent_time_ns = time_ns(bytes, now),
          .echo_held_ns = time_ns(bytes, now)};
}

JacketProfile jacket_profile() {
  JacketProfile profile =
      profile_of({motor(1, middle_of(1), {1, 2}), motor(2, middle_of(8), {7, 8, 9}), motor(3, middle_of(20), {20, 21})},
                 Uncovered::nearest);
  profile.rendering = Rendering::places;
  for (Actuator& actuator : profile.actuators) {
    actuator.max_strength = strongest;
    actuator.kick = 30ms;
  }
  return profile;
}

// The wearer's side as passive_daemon.cpp puts it together, without its threads.
class Wearer {
 public:
  void step(Bytes& bytes) {
    switch (bytes.byte() % 4) {
      case 0:
        hear(heartbeat(bytes, clock_.now()));
        break;
      case 1:
        hear(touch(bytes, clock_.now()));
        break;
      case 2:
        hear(StopAll{session(bytes), Side::active, sequence(bytes), bytes.byte() % 2 == 0, ""});
        break;
      default:
        pass(std::chrono::milliseconds(bytes.byte()) * (bytes.byte() % 16 == 0 ? 1000 : 1));
        break;
    }
    check();
  }

 private:
  void hear(const Heartbeat& heartbeat) {
    if (validate(heartbeat) != nullptr || !monitor_.heard(heartbeat, clock_.now())) return;
    exchange_.heard(heartbeat, clock_.now());
    require(exchange_.round_trip().value_or(0ns) >= 0ns && exchange_.smoothed_round_trip().value_or(0ns) >= 0ns);
    require(exchange_.one_way().value_or(0ns) >= 0ns);
    require(validate(exchange_.beat(clock_.now())) == nullptr);
    pipeline_.observe(heartbeat, clock_.now());
    safety_.on_heartbeat(0, clock_.now());
    heard_ = clock_.now();
  }
  void hear(const TouchEvent& touch) {
    if (validate(touch) != nullptr) return;
    for (const Felt& felt : pipeline_.process(touch, clock_.now()))
      require(validate(felt) == nullptr);
  }
  void hear(const StopAll& word) {
    if (validate(word) != nullptr) return;
    stop_.heard(word);
    std::uint64_t& newest = newest_word_[word.session];
    require(!word.stop || word.sequence <= newest || stop_.stopped());
    newest = std::max(newest, word.sequence);
    follow_stop();
  }
  void follow_stop() {
    if (stop_.stopped() && !safety_.stopped()) safety_.stop("the other side", clock_.now());
    if (!stop_.stopped() && safety_.stopped()) safety_.resume();
  }
  void pass(Duration time) {
    for (; time > 0ms; time -= 10ms) {
      clock_.advance(std::min<Duration>(time, 10ms));
      pipeline_.tick(clock_.now());
      safety_.tick(clock_.now());
      check();
      if (time > 2s) {  // nothing changes meanwhile
        clock_.advance(time - 2s);
        time = 2s;
      }
    }
  }
  void check() {
    const Timestamp now = clock_.now();
    bool runs = false;
    for (std::size_t channel = 0; channel < jacket_.motors.size(); ++channel) {
      const int intensity = jacket_.intensity(channel, now);
      require(intensity <= std::lround(255 * strongest));
      runs = runs || intensity > 0;
    }
    require(!runs || !stop_.stopped());
    require(!runs || (monitor_.alive(now) && now - heard_ <= peer_timeout));
    jacket_.frames.clear();
  }

  FakeClock clock_;
  FakeJacket jacket_;
  JacketProfile profile_ = jacket_profile();
  SafetyStage safety_{std::make_unique<FakeJacketLink>(jacket_), profile_, {}};
  MetricsRegistry metrics_;
  SenderTurn turn_{false};
  PassivePipeline pipeline_{0, profile_, safety_, turn_, 200ms, other_session, clock_, metrics_};
  HeartbeatExchange exchange_{other_session, Side::passive};
  PeerMonitor monitor_;
  StopLatch stop_;
  Timestamp heard_;
  std::map<SessionId, std::uint64_t> newest_word_;
};

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  telehug::Bytes bytes(data, size);
  telehug::Wearer wearer;
  while (!bytes.empty())
    wearer.step(bytes);
  return 0;
}
