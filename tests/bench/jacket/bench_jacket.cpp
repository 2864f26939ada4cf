// SPDX-License-Identifier: Apache-2.0
//
// What the stages between a received touch and the link cost: time and allocations per event.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <vector>

#include "jacket/load_jacket_profile.hpp"
#include "rendering/jacket_renderer.hpp"
#include "safety/safety_stage.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace {
std::size_t allocations = 0;
}  // namespace

// Every allocation of the program is counted. Not inlined: g++ would then see free() paired with new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc{};
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace telehug {
namespace {

constexpr int warm_up_events = 2'000;
constexpr int measured_events = 200'000;
constexpr Duration frame_interval = 5ms;  // 200 touches a second

// A jacket that takes every command: what is measured ends where the link begins.
class SwallowingLink final : public JacketLink {
 public:
  void poll(Timestamp) override { status_.state = LinkState::armed; }
  bool send(const MotorCommands& commands, Timestamp) override {
    commands_ += commands.size();
    return true;
  }
  bool heat(const HeaterCommands&, Timestamp) override { return false; }
  void stop_all(Timestamp) override {}
  [[nodiscard]] const LinkStatus& status() const override { return status_; }

 private:
  LinkStatus status_;
  std::size_t commands_ = 0;
};

// Two fingers wander over the body; every tenth event one goes up, and a tap comes late.
struct Touches {
  TouchEvent event = event_of(1, {contact_in(1, 1), contact_in(20, 2)});
  std::array<Transition, 1> late{};

  std::span<const Transition> next() {
    ++event.sequence;
    event.frame_time_ns += std::chrono::nanoseconds(frame_interval).count();
    const bool tenth = event.sequence % 10 == 0;
    for (Contact& contact : event.contacts) {
      const int box = static_cast<int>((event.sequence * contact.id / 3) % 20) + 1;
      contact.box = static_cast<std::uint16_t>(box);
      contact.body = middle_of(box);
      contact.phase = tenth ? Phase::up : Phase::move;
    }
    if (!tenth) return {};
    late[0] = {event.sequence - 1, event.frame_time_ns - 5'000'000, contact_in(8, 7)};
    return late;
  }
};

struct Figure {
  std::vector<double> us;

  [[nodiscard]] double percentile(double part) {
    const auto at = us.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(us.size() - 1));
    std::nth_element(us.begin(), at, us.end());
    return *at;
  }
};

double us_between(Timestamp from, Timestamp to) {
  return to_ms(to - from) * 1000;
}

nlohmann::json measure(const JacketProfile& profile) {
  SafetyStage safety(std::make_unique<SwallowingLink>(), profile, {});
  const SteadyClock clock;
  Timestamp now = clock.now();
  Touches touches;
  JacketRenderer renderer(profile, 200ms);
  std::map<std::string, Figure> figures;
  for (const char* name : {"jacket.event_to_commands", "jacket.touch_to_drives", "jacket.touch_to_drives_between",
                           "jacket.safety_apply", "jacket.safety_tick"}) {
    figures[name].us.reserve(measured_events);
  }
  Figure& whole = figures["jacket.event_to_commands"];
  Figure& planning = figures["jacket.touch_to_drives"];
  Figure& going_on = figures["jacket.touch_to_drives_between"];
  Figure& applying = figures["jacket.safety_apply"];
  Figure& ticking = figures["jacket.safety_tick"];

  std::size_t allocations_before = 0;
  for (int i = -warm_up_events; i < measured_events; ++i) {
    if (i == 0) allocations_before = allocations;
    now += frame_interval;
    const auto fresh = touches.next();
    safety.on_heartbeat(0, now);
    const Timestamp begun = clock.now();
    renderer.tick(now);
    const Timestamp gone_on = clock.now();
    safety.tick(now);
    const Timestamp ticked = clock.now();
    const JacketPlan& plan = renderer.plan(touches.event, fresh, now);
    const Timestamp planned = clock.now();
    safety.apply(0, plan.drives, now);
    const Timestamp applied = clock.now();
    if (i < 0) continue;
    going_on.us.push_back(us_between(begun, gone_on));
    ticking.us.push_back(us_between(gone_on, ticked));
    planning.us.push_back(us_between(ticked, planned));
    applying.us.push_back(us_between(planned, applied));
    whole.us.push_back(us_between(ticked, applied));
  }
  const double per_event = static_cast<double>(allocations - allocations_before) / measured_events;

  nlohmann::json results;
  for (auto& [name, figure] : figures) {
    results[name] = {{"p50", figure.percentile(0.5)}, {"p99", figure.percentile(0.99)}, {"unit", "us"}};
  }
  results["jacket.allocations_per_event"] = {{"p50", per_event}, {"p99", per_event}, {"unit", "1"}};
  return results;
}

int run(int argc, char** argv) {
  CLI::App app{"Cost of the stages between a received touch and the jacket's link"};
  std::string json_file;
  app.add_option("--json", json_file, "Write the figures to this file");
  CLI11_PARSE(app, argc, argv);

  auto profile = load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml");
  if (!profile) {
    fmt::print(stderr, "{}\n", profile.error().message);
    return 1;
  }
  profile->rendering = Rendering::places;  // the dearer one
  const nlohmann::json results = measure(profile.value());
  fmt::print("{:<34}{:>10}{:>10}  unit\n", "figure", "p50", "p99");
  for (const auto& [name, figure] : results.items()) {
    fmt::print("{:<34}{:>10.3f}{:>10.3f}  {}\n", name, figure["p50"].get<double>(), figure["p99"].get<double>(),
               figure["unit"].get<std::string>());
  }
  if (json_file.empty()) return 0;
  std::ofstream file(json_file);
  file << results.dump(2) << '\n';
  if (file.flush()) return 0;
  fmt::print(stderr, "{}: the figures can't be written there\n", json_file);
  return 1;
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) {
  try {
    return telehug::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_jacket: {}\n", error.what());
    return 1;
  }
}
