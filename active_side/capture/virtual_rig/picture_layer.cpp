// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/picture_layer.hpp"

#include <algorithm>

namespace telehug {

void PictureLayer::clear() {
  box = {};
  columns.clear();
}

void PictureLayer::take(const MeshRaster& raster) {
  box = raster.box();
  columns.resize(static_cast<std::size_t>(box.height));
  image.create(box.size(), CV_32FC4);
  height_mm.create(box.size(), CV_32FC1);
  image = cv::Scalar::all(0);
  height_mm = cv::Scalar::all(0);
  for (int row = 0; row < box.height; ++row) {
    auto* pixel = image.ptr<cv::Vec4f>(row) - box.x;
    float* height = height_mm.ptr<float>(row) - box.x;
    const cv::Range drawn = raster.columns(row + box.y);
    columns[static_cast<std::size_t>(row)] = {drawn.start - box.x, drawn.end - box.x};
    raster.row(row + box.y, drawn, [&](int u, const Light& light, float coverage, float pixel_height_mm) {
      pixel[u] = {light[0] * coverage, light[1] * coverage, light[2] * coverage, coverage};
      height[u] = pixel_height_mm;
    });
  }
}

void PictureLayer::widen_columns(int by_rows, int by_columns) {
  const std::vector<cv::Range> before = columns;
  const auto rows = static_cast<int>(before.size());
  for (int row = 0; row < rows; ++row) {
    cv::Range& widened = columns[static_cast<std::size_t>(row)];
    for (int other = std::max(0, row - by_rows); other <= std::min(rows - 1, row + by_rows); ++other)
      widened = joined(widened, before[static_cast<std::size_t>(other)]);
    if (!widened.empty())
      widened = {std::max(0, widened.start - by_columns), std::min(box.width, widened.end + by_columns)};
  }
}

cv::Range PictureLayer::columns_within(const cv::Range& v) const {
  cv::Range all(0, 0);
  for (int row = std::max(v.start, box.y); row < std::min(v.end, box.y + box.height); ++row)
    all = joined(all, columns[static_cast<std::size_t>(row - box.y)]);
  return all.empty() ? all : cv::Range(all.start + box.x, all.end + box.x);
}

}  // namespace telehug
