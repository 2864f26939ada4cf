// SPDX-License-Identifier: Apache-2.0
#include "bench/touch/detector_stages.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "finger/background_strip.hpp"
#include "finger/border_strip.hpp"
#include "finger/crossing.hpp"
#include "finger/edge_map.hpp"
#include "finger/finger_axis.hpp"
#include "finger/finger_colours.hpp"
#include "finger/tip_contour.hpp"
#include "finger/tip_search.hpp"
#include "finger/tip_shape.hpp"

namespace telehug {
namespace {

constexpr std::array stages{"strip", "foreground", "crossings", "edges", "colours", "guesses", "contour", "tip"};
using StageTimes = std::array<double, stages.size()>;

BorderStrip sampled(const cv::Mat& bgr, const BorderStrip::Layout& layout) {
  BorderStrip strip(layout);
  strip.sample(bgr, layout);
  return strip;
}

// The stages as FingerDetector calls them.
class StagedDetector {
 public:
  StagedDetector(const BorderCurve& border, const cv::Mat& empty)
      : border_(border),
        image_{empty.cols, empty.rows},
        layout_(border, image_),
        strip_(sampled(empty, layout_)),
        background_(layout_, strip_),
        crossing_finder_(layout_),
        edges_(image_),
        colours_(image_),
        tip_search_(image_) {}

  StageTimes detect(const cv::Mat& bgr) {
    StageTimes ms{};
    Stopwatch watch;
    strip_.sample(bgr, layout_);
    ms[0] = watch.lap_ms();
    const auto& foreground = background_.distance(strip_);
    ms[1] = watch.lap_ms();
    const Crossings& crossings = crossing_finder_.find(foreground, background_.new_edges(), bgr, border_);
    ms[2] = watch.lap_ms();
    for (const Crossing& crossing : crossings)
      add_finger(bgr, FingerAxis(crossing, border_), ms);
    return ms;
  }

 private:
  void add_finger(const cv::Mat& bgr, const FingerAxis& axis, StageTimes& ms) {
    const double scale = image_.height_px / 720.0;
    const double border_v = axis.border_v_px();
    const int last_v = image_.height_px - 4;
    const double a = axis.half_width(border_v);
    const int first_v = std::max(0, static_cast<int>(border_v - 24 * scale - 4.5 * a));
    const auto [left_u, right_u] = std::minmax(axis.centre_u(first_v), axis.centre_u(last_v));
    const double beside_px = 1.25 * a + 30 * scale;
    const auto left = static_cast<int>(left_u - beside_px);
    const auto right = static_cast<int>(right_u + beside_px);
    Stopwatch watch;
    edges_.compute(bgr, {left, first_v, right - left, image_.height_px - first_v});
    ms[3] += watch.lap_ms();
    colours_.learn(bgr, axis, last_v, {});
    ms[4] += watch.lap_ms();
    const auto guesses = tip_search_.find(edges_, axis, last_v, scale);
    ms[5] += watch.lap_ms();
    if (guesses.empty()) return;
    const TipContour contour = contour_finder_.find(bgr, guesses, colours_);
    ms[6] += watch.lap_ms();
    const double slope = border_.slope_at(axis.centre_u(border_v));
    tip_sum_px_ += fit_tip_shape(contour, guesses.front().finger_half_width_px, slope).tip.v_px;
    ms[7] += watch.lap_ms();
  }

  BorderCurve border_;
  ImageSize image_;
  BorderStrip::Layout layout_;
  BorderStrip strip_;
  BackgroundStrip background_;
  CrossingFinder crossing_finder_;
  EdgeMap edges_;
  FingerColours colours_;
  TipSearch tip_search_;
  TipContourFinder contour_finder_;
  double tip_sum_px_ = 0;  // so that nothing is left out as unused
};

}  // namespace

Figures measure_stages(const BorderCurve& border, const cv::Mat& empty, const std::vector<cv::Mat>& pictures,
                       const std::string& suffix) {
  StagedDetector detector(border, empty);
  Figures figures;
  for (const char* const stage : stages)
    figures.push_back({std::string("touch.stage.") + stage + suffix, "ms"});
  for (int i = 0; i < bench_warm_up_rounds + bench_rounds; ++i) {
    const StageTimes ms = detector.detect(pictures[static_cast<std::size_t>(i) % pictures.size()]);
    if (i < bench_warm_up_rounds) continue;
    for (std::size_t k = 0; k < stages.size(); ++k)
      figures[k].samples.push_back(ms[k]);
  }
  return figures;
}

}  // namespace telehug
