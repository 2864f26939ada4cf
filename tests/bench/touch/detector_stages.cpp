// SPDX-License-Identifier: Apache-2.0
#include "bench/touch/detector_stages.hpp"

#include <array>

#include "finger/background_strip.hpp"
#include "finger/border_strip.hpp"
#include "finger/overview.hpp"
#include "finger/picture_scale.hpp"
#include "finger/tip_patch.hpp"
#include "net/overview_net.hpp"
#include "net/tip_net.hpp"

namespace telehug {
namespace {

constexpr std::array stages{"strip", "foreground", "overview", "tips", "patch", "look"};
using StageTimes = std::array<double, stages.size()>;

BorderStrip sampled(const cv::Mat& bgr, const BorderStrip::Layout& layout) {
  BorderStrip strip(layout);
  strip.sample(bgr, layout);
  return strip;
}

std::vector<OverviewNet> nets_of(const Overview& overview) {
  std::vector<OverviewNet> nets;
  for (const int columns : overview.tile_columns())
    nets.emplace_back(overview.rows(), columns);
  return nets;
}

// The stages as FingerDetector calls them, with one look at each tip.
class StagedDetector {
 public:
  StagedDetector(const BorderCurve& border, const RigCamera& camera, const cv::Mat& empty)
      : camera_(camera),
        layout_(border, {empty.cols, empty.rows}),
        strip_(sampled(empty, layout_)),
        background_(layout_, strip_),
        overview_(border, layout_, px_per_mm_at(camera, {empty.cols / 2.0, border.v_at(empty.cols / 2.0)}).value_or(1)),
        nets_(nets_of(overview_)) {}

  StageTimes detect(const cv::Mat& bgr) {
    StageTimes ms{};
    Stopwatch watch;
    strip_.sample(bgr, layout_);
    ms[0] = watch.lap_ms();
    const auto& foreground = background_.distance(strip_);
    ms[1] = watch.lap_ms();
    for (const Overview::Tile& tile : overview_.tiles(foreground)) {
      OverviewNet& net = nets_[tile.width];
      Stopwatch of_tile;
      overview_.sample(bgr, tile.first_column, overview_.tile_columns()[tile.width], net.cells());
      ms[2] += of_tile.lap_ms();
      const OverviewNet::Tips tips = net.find(0);
      ms[3] += of_tile.lap_ms();
      for (const OverviewNet::Tip& tip : tips)
        look_at(bgr, overview_.picture_point(tile.first_column + tip.column, tip.row), ms);
    }
    return ms;
  }

 private:
  void look_at(const cv::Mat& bgr, const ImagePoint& tip, StageTimes& ms) {
    Stopwatch watch;
    const double step_px = px_per_mm_at(camera_, tip).value_or(1) / patch_px_per_mm;
    sample_patch(bgr, {tip, step_px, step_px / patch_rows_per_column, TipNet::columns, TipNet::rows}, tip_net_.patch());
    ms[4] += watch.lap_ms();
    row_sum_ += tip_net_.look(0, 0).row;
    ms[5] += watch.lap_ms();
  }

  RigCamera camera_;
  BorderStrip::Layout layout_;
  BorderStrip strip_;
  BackgroundStrip background_;
  Overview overview_;
  std::vector<OverviewNet> nets_;
  TipNet tip_net_;
  double row_sum_ = 0;  // so that nothing is left out as unused
};

}  // namespace

Figures measure_stages(const BorderCurve& border, const RigCamera& camera, const cv::Mat& empty,
                       const std::vector<cv::Mat>& pictures, const std::string& suffix) {
  StagedDetector detector(border, camera, empty);
  Figures figures;
  for (const char* const stage : stages)
    figures.push_back({std::string("touch.stage.") + stage + suffix, "ms"});
  cv::Mat picture;
  for (int i = 0; i < bench_warm_up_rounds + bench_rounds; ++i) {
    pictures[static_cast<std::size_t>(i) % pictures.size()].copyTo(picture);
    const StageTimes ms = detector.detect(picture);
    if (i < bench_warm_up_rounds) continue;
    for (std::size_t k = 0; k < stages.size(); ++k)
      figures[k].samples.push_back(ms[k]);
  }
  return figures;
}

}  // namespace telehug
