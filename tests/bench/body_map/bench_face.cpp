// SPDX-License-Identifier: Apache-2.0
//
// What the face step costs, by itself and beside the touch path.
//   bench_face [--json FILE]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "bench/body_map/face_figures.hpp"
#include "bench/touch/print_figures.hpp"

namespace telehug {
namespace {

void run(const std::string& json) {
  cv::setNumThreads(1);
  Figures figures;
  const auto add = [&](Figures more) {
    for (Figure& figure : more)
      figures.push_back(std::move(figure));
  };
  add(measure_face_step({1280, 1024}));
  add(measure_face_step({1920, 1080}));
  add(measure_box_at());
  add(measure_looking_at_a_screen());
  add(measure_touch_beside_face());
  print_and_write(figures, json);
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) try {
  CLI::App app("Times of the face step");
  std::string json;
  app.add_option("--json", json, "Write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  telehug::run(json);
  return 0;
} catch (const std::exception& exception) {
  std::fprintf(stderr, "bench_face: %s\n", exception.what());
  return 1;
}
