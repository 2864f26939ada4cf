// SPDX-License-Identifier: Apache-2.0
//
// What the face step costs: bench_face [--json FILE] [--rounds N]. Times are of one thread, from the changed screen
// picture in memory to the body map.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "body_map/body_map_step.hpp"
#include "body_map/vitruvian_grid.hpp"
#include "doubles/planned_screen_grabber.hpp"
#include "face/haar_face_finder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using Figures = nlohmann::ordered_json;

double percentile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

void measure(Figures& figures, const std::string& name, int rounds, const std::function<void()>& work) {
  const SteadyClock clock;
  work();  // caches and buffers
  std::vector<double> times_ms;
  for (int i = 0; i < rounds; ++i) {
    const Timestamp start = clock.now();
    work();
    times_ms.push_back(to_ms(clock.now() - start));
  }
  std::sort(times_ms.begin(), times_ms.end());
  const double p50 = percentile(times_ms, 0.50);
  const double p99 = percentile(times_ms, 0.99);
  figures[name] = {{"p50", p50}, {"p99", p99}, {"unit", "ms"}};
  fmt::print("{:<32}{:>10.4f}{:>10.4f} ms\n", name, p50, p99);
}

// The chat as high as the screen, between black bars.
cv::Mat on_screen(const cv::Mat& chat, cv::Size size) {
  cv::Mat screen(size, CV_8UC3, cv::Scalar(0, 0, 0));
  const int width = chat.cols * size.height / chat.rows;
  cv::resize(chat, screen(cv::Rect((size.width - width) / 2, 0, width, size.height)), {width, size.height}, 0, 0,
             cv::INTER_AREA);
  return screen;
}

void bench_size(Figures& figures, FaceFinder& finder, const cv::Mat& chat, cv::Size size, int rounds) {
  PlannedScreenGrabber grabber;
  grabber.picture.bgr = on_screen(chat, size);
  grabber.picture.monitor = {.width_px = size.width, .height_px = size.height};
  BodyMapStep step(grabber, finder,
                   {.screen = {.width_mm = 480, .height_mm = 300, .width_px = size.width, .height_px = size.height},
                    .rules = {},
                    .tracker = {}});
  const std::string pixels = fmt::format("{}x{}", size.width, size.height);

  measure(figures, "face.cycle_" + pixels, rounds, [&step] { step.run(); });
  if (step.map().version == 0) {
    fmt::print("  (no face: {})\n", step.problem());
  }
  grabber.outcome = GrabOutcome::unchanged;
  measure(figures, "face.cycle_" + pixels + ".unchanged", rounds, [&step] { step.run(); });
  // What any finder pays that looks at every pixel once: grey at the size in which is searched.
  cv::Mat small, grey;
  measure(figures, "face.cycle_" + pixels + ".bound", rounds, [&] {
    cv::resize(grabber.picture.bgr, small, {640, 640 * size.height / size.width}, 0, 0, cv::INTER_AREA);
    cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  });
}

void bench_box_at(Figures& figures, int rounds) {
  const auto map = make_body_map({.x_mm = 200, .y_mm = 40, .width_mm = 60, .height_mm = 80},
                                 {.x_mm = 0, .y_mm = 0, .width_mm = 480, .height_mm = 300});
  constexpr int touches = 1000;
  unsigned boxes = 0;
  measure(figures, "face.box_at_x1000", rounds, [&] {
    for (int i = 0; i < touches; ++i) {
      const auto hit = box_at(*map, {.x_mm = 0.48 * i, .y_mm = 0.3 * i});
      boxes += hit ? hit->box : 0U;
    }
  });
  if (boxes == 0) {
    fmt::print("  (no box was hit)\n");
  }
}

int run(const std::string& json, int rounds) {
  const auto finder = make_haar_face_finder();
  if (!finder) {
    fmt::print(stderr, "{}\n", finder.error().message);
    return 1;
  }
  const auto chat = read_picture(TELEHUG_FIXTURES "/chat/01_full.jpg");
  if (!chat) {
    fmt::print(stderr, "{}\n", chat.error().message);
    return 1;
  }
  cv::setNumThreads(1);
  fmt::print("{:<32}{:>10}{:>10}\n", (*finder)->name() + ", " + std::to_string(rounds) + " rounds", "p50", "p99");
  Figures figures;
  for (const cv::Size size : {cv::Size(1280, 1024), cv::Size(1920, 1080)}) {
    bench_size(figures, **finder, *chat, size, rounds);
  }
  bench_box_at(figures, rounds);
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
  CLI::App app("Times of the face step");
  std::string json;
  int rounds = 100;
  app.add_option("--json", json, "Write the figures to this file");
  app.add_option("--rounds", rounds, "How often each is measured")->check(CLI::Range(1, 100000));
  CLI11_PARSE(app, argc, argv);
  return telehug::run(json, rounds);
} catch (const std::exception& exception) {
  std::fprintf(stderr, "bench_face: %s\n", exception.what());
  return 1;
}
