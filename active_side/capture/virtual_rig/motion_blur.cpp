// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/motion_blur.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>
#include <utility>

namespace telehug {
namespace {

constexpr int most_places = 24;  // beyond that a step is larger than a pixel, which the eye does not notice

}  // namespace

void MotionBlur::apply(PictureLayer& layer, float du_px, float dv_px) {
  const float way_px = std::max(std::abs(du_px), std::abs(dv_px));
  const int places = std::min(most_places, static_cast<int>(std::lround(way_px)) + 1);
  if (places < 2 || layer.box.empty()) return;
  layer.widen_columns(static_cast<int>(std::abs(dv_px) / 2) + 1, static_cast<int>(std::abs(du_px) / 2) + 1);
  std::swap(before_, layer.image);
  layer.image.create(before_.size(), CV_32FC4);
  layer.image = cv::Scalar::all(0);
  const cv::v_float32x4 share = cv::v_setall_f32(1.0F / static_cast<float>(places));
  for (int place = 0; place < places; ++place) {
    const float along = static_cast<float>(place) / static_cast<float>(places - 1) - 0.5F;
    const int left = static_cast<int>(std::lround(du_px * along));
    const int up = static_cast<int>(std::lround(dv_px * along));
    for (int v = 0; v < before_.rows; ++v) {
      const cv::Range& columns = layer.columns[static_cast<std::size_t>(v)];
      const auto* from = before_.ptr<cv::Vec4f>(std::clamp(v - up, 0, before_.rows - 1));
      auto* to = layer.image.ptr<cv::Vec4f>(v);
      for (int u = columns.start; u < columns.end; ++u) {
        const cv::Vec4f& shown = from[std::clamp(u - left, 0, before_.cols - 1)];
        cv::v_store(to[u].val, cv::v_load(to[u].val) + cv::v_load(shown.val) * share);
      }
    }
  }
}

}  // namespace telehug
