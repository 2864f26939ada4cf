// SPDX-License-Identifier: Apache-2.0
#include "bench/body_map/face_figures.hpp"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "body_map/body_map_step.hpp"
#include "body_map/vitruvian_grid.hpp"
#include "doubles/planned_screen_grabber.hpp"
#include "face/make_face_finder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

constexpr int rounds = 200;

Figure measure(const std::string& name, const std::function<void()>& work) {
  Figure figure{name, "ms"};
  work();  // caches and buffers
  for (int i = 0; i < rounds; ++i) {
    Stopwatch watch;
    work();
    figure.samples.push_back(watch.lap_ms());
  }
  return figure;
}

}  // namespace

cv::Mat chat_on_screen(cv::Size size) {
  const auto chat = read_picture(TELEHUG_FIXTURES "/chat/01_full.jpg");
  if (!chat) throw std::runtime_error(chat.error().message);
  cv::Mat screen(size, CV_8UC3, cv::Scalar(0, 0, 0));
  const int width = chat->cols * size.height / chat->rows;
  cv::resize(*chat, screen(cv::Rect((size.width - width) / 2, 0, width, size.height)), {width, size.height}, 0, 0,
             cv::INTER_AREA);
  cv::Mat bgrx;
  cv::cvtColor(screen, bgrx, cv::COLOR_BGR2BGRA);
  return bgrx;
}

Figures measure_face_step(cv::Size size) {
  const std::string pixels = fmt::format("{}x{}", size.width, size.height);
  PlannedScreenGrabber grabber;
  grabber.picture.bgr = chat_on_screen(size);
  grabber.picture.monitor = {.width_px = size.width, .height_px = size.height};
  Figures figures;
  for (const char* name : {"blaze", "haar"}) {
    auto finder = make_face_finder(name);
    if (!finder || !finder->note.empty()) throw std::runtime_error(std::string("there is no finder ") + name);
    BodyMapStep step(
        grabber, *finder->finder,
        {.screen = ScreenSize{.width_mm = 480, .height_mm = 300, .width_px = size.width, .height_px = size.height},
         .rules = {},
         .tracker = {},
         .mirrored = false});
    const auto look = [&](GrabOutcome outcome) {
      grabber.outcome = outcome;
      grabber.picture.time += 125ms;
      step.run();
    };
    figures.push_back(measure(fmt::format("face.cycle_{}.{}", pixels, name), [&] { look(GrabOutcome::changed); }));
    if (step.map().version == 0) throw std::runtime_error(step.problem());
    figures.push_back(
        measure(fmt::format("face.cycle_{}.{}.unchanged", pixels, name), [&] { look(GrabOutcome::unchanged); }));
  }
  cv::Mat half;
  figures.push_back(measure(fmt::format("face.cycle_{}.bound", pixels),
                            [&] { cv::resize(grabber.picture.bgr, half, size / 2, 0, 0, cv::INTER_AREA); }));
  return figures;
}

Figures measure_box_at() {
  const auto map = make_body_map({.x_mm = 200, .y_mm = 40, .width_mm = 60, .height_mm = 80},
                                 {.x_mm = 0, .y_mm = 0, .width_mm = 480, .height_mm = 300});
  constexpr int touches = 1000;
  unsigned boxes = 0;
  Figure figure = measure("face.box_at_x1000", [&] {
    for (int i = 0; i < touches; ++i) {
      const auto hit = box_at(*map, {.x_mm = 0.48 * i, .y_mm = 0.3 * i});
      boxes += hit ? hit->box : 0U;
    }
  });
  if (boxes == 0) throw std::runtime_error("no box was hit");
  return {std::move(figure)};
}

}  // namespace telehug
