// SPDX-License-Identifier: Apache-2.0
//
// From the touch that has arrived to the bytes on the wire and the motor's pin: the real telehug-passive, the real
// firmware in its simulator, and a wire between them that is listened to. Then 200 touches a second for long: does
// anything grow?
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/pins/set_log.hpp"
#include "bench/pins/touching_peer.hpp"
#include "doubles/wire_between.hpp"
#include "integration/app/running_pair.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

struct Options {
  int taps = 300;
  int seconds = 60;
  int rate_hz = 200;
  std::string profile = "duemilanove-16.toml";
  std::string json;
};

constexpr int boxes_with_motors = 20;

double percentile(std::vector<double>& values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double ms_between(std::int64_t from_time_ns, std::int64_t to_time_ns) {
  return static_cast<double>(to_time_ns - from_time_ns) * 1e-6;
}

struct Report {
  nlohmann::json json;
  void add(const std::string& name, std::vector<double> ms) {
    if (ms.empty()) throw std::runtime_error("nothing was measured of " + name);
    const double p50 = percentile(ms, 0.5);
    const double p99 = percentile(ms, 0.99);
    fmt::print("{:<44} {:>9.3f} {:>9.3f} {:>9.3f} {:>7}\n", name, p50, p99, percentile(ms, 1), ms.size());
    json[name] = {{"p50", p50}, {"p99", p99}, {"unit", "ms"}};
  }
};

class Bench {
 public:
  explicit Bench(Options options) : options_(std::move(options)) {
    pair_.start_jacket();
    if (!eventually([&] { return std::filesystem::exists(pair_.folder / "jacket"); }))
      throw std::runtime_error("the simulated jacket does not start: " + pair_.logs());
    wire_.emplace(pair_.folder / "wire", pair_.folder / "jacket",
                  [this](WireBetween::Way way, std::span<const std::uint8_t> bytes, Timestamp time) {
                    if (way == WireBetween::Way::to_jacket) sets_.note(bytes, time);
                    return WireBetween::unchanged(way, bytes, time);
                  });
    pair_.jacket_link = "serial:" + (pair_.folder / "wire").string();
    pair_.passive_settings.push_back("jacket.profile=" TELEHUG_SOURCE "/deploy/jackets/" + options_.profile);
    pair_.start_passive();
    peer_.emplace(DdsSettings{.side = Side::active, .domain_id = pair_.domain(), .partition = pair_.partition()});
    if (!eventually([&] { return peer_->heard() && pair_.jacket_state() == "armed"; }))
      throw std::runtime_error("the two sides do not meet: " + pair_.logs());
  }

  void run() {
    fmt::print("{:<44} {:>9} {:>9} {:>9} {:>7}\n", "from the event's arrival, ms", "p50", "p99", "max", "");
    single_taps();
    many_touches();
    if (!options_.json.empty()) std::ofstream(options_.json) << report_.json.dump(2) << '\n';
  }

 private:
  // Taps of 100 ms, each on another box, far enough apart that every motor rests before it is touched again.
  void single_taps() {
    (void)sets_.take();
    (void)peer_->take_answers();
    std::vector<Felt> downs;
    for (int i = 0; i < options_.taps; ++i) {
      Contact contact = contact_in(1 + i * 7 % boxes_with_motors, static_cast<std::uint32_t>(i + 1));
      contact.phase = Phase::down;
      peer_->send({contact});
      // Not in step with anything that the daemon does at intervals.
      std::this_thread::sleep_for(std::chrono::milliseconds(90 + i * 13 % 37));
      contact.phase = Phase::up;
      peer_->send({contact});
      std::this_thread::sleep_for(250ms);
      for (const Felt& answer : peer_->take_answers())
        if (answer.phase == Phase::down && answer.outcome == FeltOutcome::driven) downs.push_back(answer);
    }
    const auto sets = sets_.take();
    const auto pins = pair_.pins();
    std::vector<double> bytes_ms;
    std::vector<double> pin_ms;
    std::vector<double> wire_ms;
    for (const Felt& down : downs) {
      const auto channels = channels_of(down);
      const auto set = std::ranges::find_if(sets, [&](const WrittenSet& written) {
        return to_ns(written.time) >= down.received_time_ns && asks_for(written, channels);
      });
      const auto rise = std::ranges::find_if(pins, [&](const PinChange& change) {
        return change.on && change.time_ns >= down.received_time_ns && channels.contains(change.channel);
      });
      if (set == sets.end() || rise == pins.end()) continue;
      bytes_ms.push_back(ms_between(down.received_time_ns, to_ns(set->time)));
      pin_ms.push_back(ms_between(down.received_time_ns, rise->time_ns));
      wire_ms.push_back(ms_between(to_ns(set->time), rise->time_ns));
    }
    report_.add("jacket.event_to_bytes", bytes_ms);
    report_.add("jacket.event_to_pin", pin_ms);
    report_.add("jacket.bytes_to_pin (wire, PWM, simulator)", wire_ms);
    fmt::print("{} of {} taps found on wire and pins\n\n", bytes_ms.size(), options_.taps);
  }

  // Four fingers that go up and down all over the body.
  void many_touches() {
    fmt::print("{} touches/s: ms from arrival to the next SET that carries the motor\n", options_.rate_hz);
    fmt::print("{:>7} {:>9} {:>9} {:>9} {:>9} {:>10} {:>9} {:>9}\n", "s", "p50", "p99", "max", "SETs/s", "memory kB",
               "replaced", "lost");
    (void)sets_.take();
    (void)peer_->take_answers();
    const SteadyClock clock;
    const Timestamp begun = clock.now();
    Timestamp sets_since = begun;
    const Duration interval = std::chrono::duration_cast<Duration>(1s) / options_.rate_hz;
    const int windows = 10;
    std::uint64_t sent = 0;
    std::vector<double> all_ms;
    for (int window = 1; window <= windows; ++window) {
      const Timestamp end = begun + std::chrono::seconds(options_.seconds) * window / windows;
      std::vector<Felt> answers;
      while (clock.now() < end) {
        std::this_thread::sleep_until(begun + interval * static_cast<std::int64_t>(++sent));
        peer_->send(touches(sent));
        if (sent % 64 == 0) std::ranges::copy(peer_->take_answers(), std::back_inserter(answers));
      }
      std::ranges::copy(peer_->take_answers(), std::back_inserter(answers));
      // The frame that carried an earlier touch, answered late, is among those of the window before.
      std::erase_if(answers, [&](const Felt& answer) { return answer.received_time_ns < to_ns(sets_since); });
      sets_since = clock.now();
      report_window(window, answers, all_ms);
    }
    report_.add(fmt::format("jacket.event_to_bytes_at_{}_per_s", options_.rate_hz), all_ms);
  }

  // Each finger touches for twenty events, and then another place; one of the four begins with every fifth event.
  static std::vector<Contact> touches(std::uint64_t sequence) {
    constexpr std::uint64_t fingers = 4;
    constexpr std::uint64_t events = 20;
    std::vector<Contact> contacts;
    for (std::uint64_t finger = 0; finger < fingers; ++finger) {
      const std::uint64_t moment = sequence + finger * events / fingers;
      const std::uint64_t age = moment % events;
      const std::uint64_t life = moment / events;
      Contact contact = contact_in(1 + static_cast<int>((life * 7 + finger * 5) % boxes_with_motors),
                                   static_cast<std::uint32_t>(life * fingers + finger + 1));
      contact.phase = age == 0 ? Phase::down : age == events - 1 ? Phase::up : Phase::move;
      contacts.push_back(contact);
    }
    return contacts;
  }

  void report_window(int window, const std::vector<Felt>& answers, std::vector<double>& all_ms) {
    const auto sets = sets_.take();
    std::vector<double> ms;
    auto first = sets.begin();
    for (const Felt& answer : answers) {
      if (answer.phase != Phase::down || answer.outcome != FeltOutcome::driven) continue;
      const auto channels = channels_of(answer);
      first = std::find_if(first, sets.end(),
                           [&](const WrittenSet& set) { return to_ns(set.time) >= answer.received_time_ns; });
      const auto set =
          std::find_if(first, sets.end(), [&](const WrittenSet& written) { return asks_for(written, channels); });
      if (set != sets.end()) ms.push_back(ms_between(answer.received_time_ns, to_ns(set->time)));
    }
    if (ms.empty()) throw std::runtime_error("no touch was felt: " + pair_.logs());
    const double window_s = options_.seconds / 10.0;
    fmt::print("{:>7.0f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.1f} {:>10} {:>9} {:>9}\n", window_s * window,
               percentile(ms, 0.5), percentile(ms, 0.99), percentile(ms, 1),
               static_cast<double>(sets.size()) / window_s, memory_kb(),
               pair_.counter(Side::passive, "events_replaced_by_newer"), pair_.counter(Side::passive, "events_lost"));
    (void)std::fflush(stdout);
    all_ms.insert(all_ms.end(), ms.begin(), ms.end());
  }

  [[nodiscard]] static std::set<int> channels_of(const Felt& felt) {
    std::set<int> channels;
    for (const std::uint8_t id : felt.actuators)
      if (id <= protocol::motor_count) channels.insert(id - 1);  // in the shipped profiles
    return channels;
  }
  [[nodiscard]] static bool asks_for(const WrittenSet& set, const std::set<int>& channels) {
    return std::ranges::any_of(channels,
                               [&](int channel) { return set.intensity.at(static_cast<std::size_t>(channel)) > 0; });
  }
  [[nodiscard]] long memory_kb() const {
    long pages = 0;
    std::ifstream statm("/proc/" + std::to_string(pair_.passive->pid()) + "/statm");
    statm >> pages >> pages;  // the second number
    return pages * (sysconf(_SC_PAGESIZE) / 1024);
  }

  Options options_;
  RunningPair pair_;
  SetLog sets_;
  std::optional<WireBetween> wire_;
  std::optional<TouchingPeer> peer_;
  Report report_;
};

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) {
  telehug::Options options;
  CLI::App app("Measures the way from a touch that has arrived to the wire and to the motor's pin");
  app.add_option("--taps", options.taps, "Single taps")->check(CLI::Range(1, 100'000));
  app.add_option("--seconds", options.seconds, "How long many touches are sent")->check(CLI::Range(1, 36'000));
  app.add_option("--rate", options.rate_hz, "Of these, a second")->check(CLI::Range(1, 1000));
  app.add_option("--profile", options.profile, "Of deploy/jackets");
  app.add_option("--json", options.json, "Write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    telehug::Bench(options).run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_pins: {}\n", error.what());
    return 1;
  }
  return 0;
}
