// SPDX-License-Identifier: Apache-2.0
//
// What both daemons use of a PC, as real processes that are a pair: while nobody is connected, while the other is
// connected and nobody touches, and while somebody touches all the time. The webcam is a recording of 1280x720 at 30
// frames a second, the chat a window of 1920x1080 of a real X server that changes ten times a second.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "bench/resources/process_use.hpp"
#include "doubles/xvfb.hpp"
#include "integration/app/chat_window.hpp"
#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

constexpr int windows = 6;
const cv::Rect screen_px(0, 0, 1920, 1080);

void plan(RunningPair& pair) {
  pair.pair_up();
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.active_settings = {"body_map.source=x11", "body_map.window=video chat"};
  // The shipped profile: motors rest when their budget is used up.
  pair.passive_settings = {"jacket.profile=" TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml"};
}

// What the camera sees over and over, 30 pictures a second: for half a second nobody, then, if somebody is `touching`,
// for a second a finger that comes, strokes and goes.
void plan_the_pictures(const RunningPair& pair, bool touching) {
  const std::filesystem::path rig = TELEHUG_FIXTURES "/rig2";
  std::vector<std::filesystem::path> pictures(15, rig / "background.jpg");
  if (touching) {
    std::vector<std::filesystem::path> strokes;
    for (const auto& picture : std::filesystem::directory_iterator(rig / "sequence"))
      if (picture.path().extension() == ".jpg") strokes.insert(strokes.end(), 2, picture.path());
    std::ranges::sort(strokes);
    pictures.insert(pictures.end(), strokes.begin(), strokes.end());
  }
  const auto folder = pair.folder / "held";
  std::filesystem::remove(folder / "1.jpg");
  for (std::size_t i = 0; i < pictures.size(); ++i)
    std::filesystem::create_symlink(pictures[i], folder / fmt::format("{:03}.jpg", i));
}

void wait_for(const RunningPair& pair, const std::string& what, const std::function<bool()>& condition) {
  if (!eventually(condition, 60s)) throw std::runtime_error("not " + what + ": " + pair.logs());
}

class Table {
 public:
  explicit Table(Duration each) : window_(each / windows) {
    fmt::print("{:<34} {:>6} {:>12} {:>12} {:>9} {:>12} {:>12} {:>9}\n", "", "min", "active CPU %", "RSS kB", "threads",
               "passive CPU %", "RSS kB", "threads");
  }
  void measure(const std::string& name, pid_t active, pid_t passive) {
    std::array last{use_of(active), use_of(passive)};
    const auto start = std::chrono::steady_clock::now();
    for (int window = 1; window <= windows; ++window) {
      std::this_thread::sleep_until(start + window_ * window);
      const std::array now{use_of(active), use_of(passive)};
      const double window_s = std::chrono::duration<double>(window_).count();
      fmt::print("{:<34} {:>6.1f}", name, window_s * window / 60);
      for (std::size_t side = 0; side < now.size(); ++side) {
        const double cpu_percent = 100 * (now[side].cpu_s - last[side].cpu_s) / window_s;
        fmt::print(" {:>12.2f} {:>12} {:>9}", cpu_percent, now[side].memory_kb, now[side].threads);
        json[fmt::format("{}, {}", name, side == 0 ? "active" : "passive")].push_back(
            {{"cpu_percent", cpu_percent}, {"memory_kb", now[side].memory_kb}});
      }
      fmt::print("\n");
      std::fflush(stdout);
      last = now;
    }
  }

  nlohmann::json json;

 private:
  Duration window_;
};

void nobody_connected(Table& table) {
  RunningPair wearer;
  RunningPair parent;  // in another domain
  plan(parent);
  plan(wearer);
  wearer.start_jacket();
  wearer.start_passive();
  parent.start_active();
  wait_for(wearer, "ready", [&] { return wearer.jacket_state() == "armed"; });
  wait_for(parent, "ready", [&] { return parent.status(Side::active).is_object(); });
  table.measure("nobody connected", parent.active->pid(), wearer.passive->pid());
}

void connected(Table& table, bool touching) {
  RunningPair pair;
  plan(pair);
  plan_the_pictures(pair, touching);
  pair.start_jacket();
  pair.start_passive();
  pair.start_active();
  wait_for(pair, "in use", [&] {
    return touching ? pair.counter(Side::passive, "events_received") > 0 : pair.counter(Side::active, "frames") > 0;
  });
  table.measure(touching ? "touched all the time" : "connected, nobody touches", pair.active->pid(),
                pair.passive->pid());
  fmt::print("{:<34} {} frames, {} touches published\n", "", pair.counter(Side::active, "frames"),
             pair.counter(Side::active, "touches_published"));
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) {
  double minutes = 1;
  std::string json;
  std::string state;
  CLI::App app("Measures what both daemons use of the processor and of the memory");
  app.add_option("--minutes", minutes, "How long in each state")->check(CLI::Range(0.1, 1000.0));
  app.add_option("--state", state, "Only this one")->check(CLI::IsMember({"alone", "connected", "touched"}));
  app.add_option("--json", json, "Write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    using namespace telehug;
    const Xvfb xvfb("1920x1080x24");
    setenv("DISPLAY", xvfb.display().c_str(), 1);
    const ChatWindow chat(xvfb.display(), screen_px);
    Table table(std::chrono::duration_cast<Duration>(std::chrono::duration<double, std::ratio<60>>(minutes)));
    const auto wanted = [&state](const char* name) { return state.empty() || state == name; };
    if (wanted("alone")) nobody_connected(table);
    if (wanted("connected")) connected(table, false);
    if (wanted("touched")) connected(table, true);
    if (!json.empty()) std::ofstream(json) << table.json.dump(2) << '\n';
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_resources: {}\n", error.what());
    return 1;
  }
  return 0;
}
