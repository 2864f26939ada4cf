// SPDX-License-Identifier: Apache-2.0
//
// What looking at an X11 screen costs: bench_screen [--json FILE] [--rounds N]. On an X server without a graphics card,
// which it starts; a real one may take longer to give its pixels.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "doubles/x11_client.hpp"
#include "doubles/xvfb.hpp"
#include "screen_x11/x11_grabber.hpp"

namespace telehug {
namespace {

using Figures = nlohmann::ordered_json;

double percentile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

void report(Figures& figures, const std::string& name, std::vector<double> times_ms) {
  std::sort(times_ms.begin(), times_ms.end());
  const double p50 = percentile(times_ms, 0.50);
  const double p99 = percentile(times_ms, 0.99);
  figures[name] = {{"p50", p50}, {"p99", p99}, {"unit", "ms"}};
  fmt::print("{:<32}{:>10.4f}{:>10.4f} ms\n", name, p50, p99);
}

double own_cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

class Bench {
 public:
  Bench(Figures& figures, int rounds) : figures_(figures), rounds_(rounds) {
    window_ = client_.open({.place_px = {0, 0, 1920, 1080}, .colour = 0x336699, .title = "chat"});
  }

  void changed(const std::string& name, X11GrabberConfig config) {
    X11Grabber grabber = opened(std::move(config));
    std::vector<double> times_ms;
    for (int i = 0; i < rounds_; ++i) {
      const GrabOutcome outcome = measure(times_ms, grabber, GrabOutcome::changed, [&] {
        client_.fill(window_, {300, 300, 640, 480}, static_cast<std::uint32_t>(i));
      });
      if (outcome == GrabOutcome::lost) throw std::runtime_error(grabber.last_error());
    }
    report(figures_, "screen.grab_" + name, times_ms);
  }

  void unchanged(const std::string& name, X11GrabberConfig config) {
    X11Grabber grabber = opened(std::move(config));
    std::vector<double> times_ms;
    for (int i = 0; i < rounds_; ++i)
      measure(times_ms, grabber, GrabOutcome::unchanged, [] {});
    report(figures_, "screen.grab_" + name + ".unchanged", times_ms);
  }

  // Of one core, for a second of looking 8 times at a still screen.
  void idle(const std::string& name, X11GrabberConfig config) {
    X11Grabber grabber = opened(std::move(config));
    ScreenPicture picture;
    constexpr int looks = 16;
    const double start_ms = own_cpu_ms();
    for (int i = 0; i < looks; ++i) {
      grabber.grab(picture);
      std::this_thread::sleep_for(125ms);
    }
    const double share = (own_cpu_ms() - start_ms) / (looks * 125.0) * 100;
    figures_["screen.idle_" + name] = {{"p50", share}, {"p99", share}, {"unit", "% of a core"}};
    fmt::print("{:<32}{:>10.4f}{:>10.4f} % of a core\n", "screen.idle_" + name, share, share);
  }

 private:
  X11Grabber opened(X11GrabberConfig config) {
    config.display = server_.display();
    X11Grabber grabber(std::move(config), clock_);
    if (const Status status = grabber.open(); !status) throw std::runtime_error(status.error().message);
    ScreenPicture picture;
    while (grabber.grab(picture) != GrabOutcome::unchanged) {
      client_.sync();
    }
    return grabber;
  }

  // Times the grab that has the outcome, not those before it.
  GrabOutcome measure(std::vector<double>& times_ms, X11Grabber& grabber, GrabOutcome wanted,
                      const std::function<void()>& draw) {
    ScreenPicture picture;
    draw();
    GrabOutcome outcome = GrabOutcome::lost;
    do {
      const Timestamp start = clock_.now();
      outcome = grabber.grab(picture);
      times_ms.push_back(to_ms(clock_.now() - start));
      if (outcome != wanted) times_ms.pop_back();
    } while (outcome != wanted && outcome != GrabOutcome::lost);
    return outcome;
  }

  Figures& figures_;
  int rounds_;
  SteadyClock clock_;
  Xvfb server_{"1920x1080x24"};
  X11Client client_{server_.display()};
  xcb_window_t window_ = 0;
};

int run(const std::string& json, int rounds) {
  fmt::print("{:<32}{:>10}{:>10}\n", "X11, 1920x1080, " + std::to_string(rounds) + " rounds", "p50", "p99");
  Figures figures;
  Bench bench(figures, rounds);
  const std::vector<std::pair<std::string, X11GrabberConfig>> watched{
      {"monitor", {}}, {"region_640x480", {.region = cv::Rect(300, 300, 640, 480)}}, {"window", {.window = "chat"}}};
  for (const auto& [name, config] : watched) {
    bench.changed(name, config);
    bench.unchanged(name, config);
    bench.idle(name, config);
  }
  if (!json.empty()) {
    std::ofstream file(json, std::ios::trunc);
    file << figures.dump(2) << '\n' << std::flush;
    if (!file) {
      fmt::print(stderr, "{} can't be written; check that its folder exists and is writable.\n", json);
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) try {
  CLI::App app("Times of looking at an X11 screen");
  std::string json;
  int rounds = 300;
  app.add_option("--json", json, "Write the figures to this file");
  app.add_option("--rounds", rounds, "How often each is measured")->check(CLI::Range(1, 100000));
  CLI11_PARSE(app, argc, argv);
  return telehug::run(json, rounds);
} catch (const std::exception& exception) {
  std::fprintf(stderr, "bench_screen: %s\n", exception.what());
  return 1;
}
