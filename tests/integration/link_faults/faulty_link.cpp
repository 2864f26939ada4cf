// SPDX-License-Identifier: Apache-2.0
#include "integration/link_faults/faulty_link.hpp"

#include <thread>

namespace telehug {
namespace {

constexpr std::uint32_t seed = 20261129;
constexpr Duration longest_return = 20s;
constexpr Duration watched_after_step = 4s;

}  // namespace

FaultyLink::FaultyLink(Pairing pairing, const std::string& wearer_at) : homes(seed) {
  pair.loopback_only = false;
  if (pairing == Pairing::done) pair.pair_up(wearer_at);
}

const NetNamespace& FaultyLink::network(Home home) const {
  const auto& hidden = hidden_[static_cast<std::size_t>(home)];
  return hidden ? hidden->network() : homes.network(home);
}

void FaultyLink::start_active() {
  const InsideNamespace inside(network(Home::parent));
  pair.start_active();
}

void FaultyLink::start_passive() {
  const InsideNamespace inside(network(Home::child));
  pair.start_passive();
}

Outcome FaultyLink::run(Home home, const std::vector<std::string>& command) const {
  const InsideNamespace inside(homes.network(home));
  return pair.run(command);
}

bool FaultyLink::start_all() {
  homes.set_both({});
  pair.start_jacket();
  start_passive();
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  homes.record(Home::parent);
  start_active();
  const bool felt = eventually([this] { return pair.felt(); });
  first_words_ = homes.take_recording(Home::parent);
  return felt && settled();
}

bool FaultyLink::settled() const {
  return eventually([this] {
    const auto pins = pair.pins();
    return !pins.empty() && pins.back().on && SteadyClock{}.now() - from_ns(pins.back().time_ns) > 400ms;
  });
}

void FaultyLink::note_return(FaultRow& row, Timestamp mended) const {
  if (!eventually([&] { return felt_times().felt_from(mended).has_value(); }, longest_return)) return;
  row.back_after_s = to_ms(*felt_times().felt_from(mended) - mended) / 1000;
}

FaultRow FaultyLink::interrupt(const std::string& fault, Since since, Duration lasts,
                               const std::function<void()>& break_it, const std::function<void()>& mend_it) {
  FaultRow row{fault};
  const Timestamp broken = SteadyClock{}.now();
  break_it();
  std::this_thread::sleep_until(broken + lasts);
  const auto silent = felt_times().silent_since(SteadyClock{}.now());
  const Timestamp reference = since == Since::last_arrival ? homes.last_arrival(Home::parent).value_or(broken) : broken;
  if (silent) row.off_after_ms = to_ms(*silent - reference);
  const Timestamp mended = SteadyClock{}.now();
  mend_it();
  note_return(row, mended);
  return row;
}

FaultRow FaultyLink::disturb(const std::string& fault, const std::function<void()>& endure,
                             const std::function<void()>& mend_it) {
  FaultRow row{fault};
  const Timestamp begun = SteadyClock{}.now();
  endure();
  const Timestamp mended = SteadyClock{}.now();
  mend_it();
  const FeltTimes times = felt_times();
  row.felt_percent = 100 * times.share(begun, mended);
  row.longest_gap_ms = to_ms(times.longest_gap(begun, mended));
  note_return(row, mended);
  return row;
}

FaultRow FaultyLink::step(const std::string& fault, const std::function<void()>& happen) {
  FaultRow row{fault};
  const Timestamp happened = SteadyClock{}.now();
  happen();
  std::this_thread::sleep_until(happened + watched_after_step);
  if (!settled()) return row;
  const Timestamp now = SteadyClock{}.now();
  const FeltTimes times = felt_times();
  const auto pause = times.pause(happened, now);
  row.off_after_ms = pause ? to_ms(pause->from - happened) : 0;
  row.back_after_s = pause ? to_ms(pause->to - happened) / 1000 : 0;
  row.longest_gap_ms = to_ms(times.longest_gap(happened, now));
  return row;
}

}  // namespace telehug
