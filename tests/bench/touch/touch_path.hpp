// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/touch/figure.hpp"
#include "body_map/vitruvian_grid.hpp"
#include "boxes_under.hpp"
#include "calibration/touch_model.hpp"
#include "doubles/allocation_counter.hpp"
#include "publish/touch_event_builder.hpp"
#include "touch/contact_tracker.hpp"
#include "touch/screen_points.hpp"

namespace telehug {

// What the path is about, besides the detector.
struct TouchedRig {
  ImageSize image;
  ScreenSize screen;
  TouchModel model;
  std::vector<cv::Mat> pictures;  // with fingers
};

// A face in the upper middle of the screen: the grid covers what the fingers touch.
inline BodyMap body_map_on(const ScreenSize& screen) {
  const double height_mm = screen.height_mm / 4;
  auto map = make_body_map({(screen.width_mm - height_mm) / 2, height_mm / 2, height_mm, height_mm},
                           {0, 0, screen.width_mm, screen.height_mm});
  if (!map) throw std::runtime_error("no grid fits the screen");
  map->version = 1;
  return *std::move(map);
}

// The whole path, from a decoded frame to the event that is sent. Names are "touch.PREFIXframeSUFFIX" and so on.
template <typename Detector>
Figures measure_path(Detector& detector, const TouchedRig& rig, const std::string& prefix, const std::string& suffix) {
  ContactTracker tracker;
  TouchEventBuilder builder("0123456789abcdef0123456789abcdef");
  const BodyMap map = body_map_on(rig.screen);
  NobodyTouched nobody;
  const std::string start = "touch." + prefix;
  Figures figures{{start + "frame" + suffix, "ms"},
                  {start + "detect" + suffix, "ms"},
                  {start + "model" + suffix, "ms"},
                  {start + "track" + suffix, "ms"},
                  {start + "box_and_event" + suffix, "ms"},
                  {start + "allocations_per_frame" + suffix, "allocations"},
                  {start + "fingers_per_frame" + suffix, "fingers"}};
  for (Figure& figure : figures)
    figure.samples.reserve(bench_rounds);
  cv::Mat picture;
  for (int i = 0; i < bench_warm_up_rounds + bench_rounds; ++i) {
    // As a decoder does, into the same buffer each time.
    rig.pictures[static_cast<std::size_t>(i) % rig.pictures.size()].copyTo(picture);
    const auto allocated = allocation_count();
    Stopwatch watch;
    const Fingers& fingers = detector.detect(picture);
    const double detect_ms = watch.lap_ms();
    const TouchedPoints touched = screen_points(fingers, rig.model, rig.screen, rig.image);
    const double model_ms = watch.lap_ms();
    const Timestamp time = Timestamp{} + i * 33ms;
    const ContactStates& contacts = tracker.update(touched.fingers, time);
    const double track_ms = watch.lap_ms();
    const BoxedContacts boxed = boxes_under(contacts, map, Duration::max(), time, nobody);
    builder.build(boxed, map.version, time, time);
    const double event_ms = watch.lap_ms();
    if (i < bench_warm_up_rounds) continue;
    const auto allocations = static_cast<double>(allocation_count() - allocated);
    const double frame_ms = detect_ms + model_ms + track_ms + event_ms;
    const std::vector<double> values{
        frame_ms, detect_ms, model_ms, track_ms, event_ms, allocations, static_cast<double>(fingers.size())};
    for (std::size_t f = 0; f < figures.size(); ++f)
      figures[f].samples.push_back(values[f]);
  }
  return figures;
}

}  // namespace telehug
