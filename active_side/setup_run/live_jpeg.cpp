// SPDX-License-Identifier: Apache-2.0
#include "setup_run/live_jpeg.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "pictures/jpeg_encoder.hpp"

namespace telehug {
namespace {

constexpr int quality = 75;

cv::Mat small(const cv::Mat& bgr) {
  if (bgr.cols <= LiveJpeg::most_columns_px) return bgr;
  const int rows = static_cast<int>(std::lround(1.0 * bgr.rows * LiveJpeg::most_columns_px / bgr.cols));
  cv::Mat smaller;
  cv::resize(bgr, smaller, {LiveJpeg::most_columns_px, std::max(1, rows)}, 0, 0, cv::INTER_AREA);
  return smaller;
}

}  // namespace

std::shared_ptr<const std::string> LiveJpeg::newest() {
  const std::lock_guard lock(mutex_);
  asked_ = clock_.now();
  return newest_;
}

void LiveJpeg::look(const cv::Mat& bgr) {
  if (bgr.empty() || bgr.type() != CV_8UC3) return;
  const Timestamp now = clock_.now();
  {
    const std::lock_guard lock(mutex_);
    if (!asked_ || now - *asked_ > asked_for) {
      newest_ = nullptr;  // who asks again is to see no old one
      return;
    }
    if (newest_ && made_ && now - *made_ < least_between) return;
  }
  const auto jpeg = encode_jpeg(small(bgr), quality);
  if (!jpeg) return;
  auto file = std::make_shared<const std::string>(jpeg->begin(), jpeg->end());
  const std::lock_guard lock(mutex_);
  newest_ = std::move(file);
  made_ = now;
}

void LiveJpeg::forget() {
  const std::lock_guard lock(mutex_);
  newest_ = nullptr;
  made_.reset();
}

}  // namespace telehug
