// SPDX-License-Identifier: Apache-2.0
//
// The demo: everything telehug does, on one PC, without any hardware.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <optional>

#include "capture/virtual_rig/virtual_rig.hpp"
#include "demo_pages.hpp"
#include "demo_record.hpp"
#include "demo_verdict.hpp"
#include "demo_view.hpp"
#include "demo_world.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "service/exit_code.hpp"
#include "service/signals.hpp"

namespace {

using namespace telehug;
using Json = nlohmann::json;

struct Options {
  std::string source;
  std::string chat_picture;
  std::string profile;
  double seconds = 12;
  bool plain = false;
  bool keep = false;
  bool pages = false;
};

// Measured: 1.5 mm along the finger, 0.3 mm across; the place of a touch that begins or ends between two frames, and a
// busy PC's dropped frames, take their part.
constexpr double largest_mean_vertical_mm = 4;
constexpr double largest_mean_horizontal_mm = 2;

constexpr Duration last_words = 1s;     // what was touched before the end is still answered and ends
constexpr Duration longest_touch = 5s;  // that the end waits for
constexpr Duration shortest_felt_touch = 100ms;

// Reads what both sides tell until the time is over and nothing is touched, stops the active side, and reads their last
// words.
DemoRecord watch(DemoWorld& world, DemoView& view, const Options& options, Signals& signals) {
  DemoRecord record;
  ControlClient passive = world.connect_to_passive();
  (void)passive.ask({{"command", "watch"}});
  world.start_active();
  ControlClient active = world.connect_to_active();
  (void)active.ask({{"command", "watch"}});

  const auto hear = [&](ControlClient& side, Duration longest) {
    const auto event = side.next(longest);
    if (!event) throw std::runtime_error(event.error().message);
    if (!*event) return false;
    record.add(**event);
    view.show(**event);
    return true;
  };
  const auto started = std::chrono::steady_clock::now();
  const auto end = started + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(options.seconds));
  std::optional<Timestamp> stopped;
  while (!stopped || std::chrono::steady_clock::now() < *stopped + last_words) {
    world.check_all_run();
    if (signals.take()) throw std::runtime_error("interrupted");
    const auto now = std::chrono::steady_clock::now();
    const bool untouched = record.published.empty() || record.published.back().phase == "up";
    if (!stopped && now >= end && (untouched || now >= end + longest_touch)) {
      ControlClient other = world.connect_to_active();
      (void)other.ask({{"command", "stop"}, {"reason", "the demo is over"}});
      stopped = now;
      record.judged_until_ns = to_ns(now - shortest_felt_touch);
    }
    hear(active, 20ms);
    while (hear(active, 0ms) || hear(passive, 0ms)) {
    }
  }
  return record;
}

void print_latencies(const char* side, const Json& status, std::initializer_list<const char*> stages) {
  const Json latencies = status.value("latency_ms", Json::object());
  for (const char* stage : stages) {
    if (!latencies.contains(stage)) continue;
    const Json& figures = latencies[stage];
    fmt::print("  {:<8} {:<20} {:>8.3f} {:>8.3f} {:>8}\n", side, stage, figures.value("p50", 0.0),
               figures.value("p99", 0.0), figures.value("count", 0));
  }
}

int count(const DemoRecord& record, const char* phase) {
  return static_cast<int>(
      std::ranges::count_if(record.published, [phase](const PublishedTouch& t) { return t.phase == phase; }));
}

ExitCode run(const Options& options) {
  // A demo that is interrupted, or whose terminal is closed, still ends the programs it started.
  Signals signals;
  const auto profile = load_jacket_profile(options.profile);
  if (!profile) {
    fmt::print(stderr, "telehug-demo: {}\n", profile.error().message);
    return ExitCode::config;
  }
  DemoSettings settings;
  settings.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  settings.source = options.source;
  settings.chat_picture = options.chat_picture;
  settings.profile = options.profile;
  fmt::print("camera: {}   chat picture: {}   jacket: {}, simulated\n", options.source, options.chat_picture,
             profile->name);
  DemoWorld world(settings);
  if (options.keep) world.keep_folder();
  if (options.pages) {
    run_for_pages(world, signals);
    return world.end() ? ExitCode::ok : ExitCode::internal;
  }
  DemoRecord record;
  {
    DemoView view(*profile, !options.plain && isatty(STDOUT_FILENO) != 0);
    record = watch(world, view, options, signals);
  }
  ControlClient passive = world.connect_to_passive();
  ControlClient active = world.connect_to_active();
  const auto active_status = active.ask({{"command", "status"}});
  const auto passive_status = passive.ask({{"command", "status"}});
  const bool ended_well = world.end();
  record.pins = read_pins(world.pins());

  const Json counters = active_status ? active_status->value("counters", Json::object()) : Json::object();
  fmt::print("\ntouches: {} seen, {} published, {} felt; {} events; {} changes of the jacket's pins\n",
             counters.value("touches_seen", 0), count(record, "down"),
             std::ranges::count_if(record.felt,
                                   [](const FeltAnswer& f) { return f.phase == "down" && f.outcome == "driven"; }),
             counters.value("events_published", 0), record.pins.size());
  fmt::print("not sent: {} outside the grid, {} without a face, {} with an old map\n",
             counters.value("touches_outside_grid", 0), counters.value("touches_without_face", 0),
             counters.value("touches_with_old_map", 0));
  fmt::print("latency, ms                          p50      p99    count\n");
  if (active_status) {
    print_latencies("active", *active_status,
                    {"camera", "finger", "touch", "box", "publish", "frame_to_published", "face"});
  }
  if (passive_status) print_latencies("passive", *passive_status, {"order", "plan", "drive", "event_to_link"});

  std::vector<std::string> wrong = faults(record, *profile);
  if (!ended_well) wrong.emplace_back("a program did not end as it should");
  if (options.source == "virtual") {
    const SteadyClock clock;
    const VirtualRig rig(VirtualRigSettings{}, clock);
    const TruthComparison truth = compare_with_truth(
        record,
        [&rig](std::uint64_t frame) {
          const VirtualTruth at = rig.truth(frame);
          return at.contact ? at.screen : std::nullopt;
        },
        rig.settings().fps);
    fmt::print(
        "against the truth: {} frames with a touch, mean error {:.2f} mm vertical, {:.2f} mm horizontal, "
        "worst {:.1f} mm; {} frames without one\n",
        truth.frames, truth.mean_vertical_mm, truth.mean_horizontal_mm, truth.worst_mm, truth.without_touch);
    if (truth.frames == 0) wrong.emplace_back("no published touch was a real one");
    if (truth.without_touch > 0) wrong.emplace_back("touches were published that did not happen");
    if (truth.mean_vertical_mm > largest_mean_vertical_mm || truth.mean_horizontal_mm > largest_mean_horizontal_mm) {
      wrong.emplace_back("the touches were published at wrong places");
    }
  }
  for (const std::string& fault : wrong)
    fmt::print("WRONG: {}\n", fault);
  if (options.keep) fmt::print("logs and pins: {}\n", world.folder().string());
  fmt::print("{}\n", wrong.empty() ? "Every published touch was felt at the right motors." : "The demo failed.");
  return wrong.empty() ? ExitCode::ok : ExitCode::mismatch;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Shows the whole chain at work on this PC, without any hardware, and checks it.", "telehug-demo");
  app.add_option("--source", options.source, "replay:DIR or virtual")->required();
  app.add_option("--chat-picture", options.chat_picture, "The picture of the video chat")->required();
  app.add_option("--profile", options.profile, "The jacket's profile")->required();
  app.add_option("--seconds", options.seconds, "How long")->check(CLI::Range(1.0, 600.0))->capture_default_str();
  app.add_flag("--plain", options.plain, "Lines instead of a live picture, even on a terminal");
  app.add_flag("--pages", options.pages, "Runs until Ctrl-C, to look at the pages of both sides in a browser");
  app.add_flag("--keep", options.keep, "Keep the logs");
  CLI11_PARSE(app, argc, argv);
  try {
    return to_int(run(options));
  } catch (const std::exception& problem) {
    fmt::print(stderr, "telehug-demo: {}\n", problem.what());
    return to_int(ExitCode::internal);
  }
}
