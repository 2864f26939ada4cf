// SPDX-License-Identifier: Apache-2.0
#include "capture/yuyv.hpp"

#include <opencv2/imgproc.hpp>

namespace telehug {

void convert_yuyv(const cv::Mat& yuyv, cv::Mat& bgr, RowRange rows) {
  if (bgr.size() != yuyv.size() || bgr.type() != CV_8UC3) bgr = cv::Mat::zeros(yuyv.size(), CV_8UC3);
  const RowRange inside = rows.within(yuyv.rows);
  if (inside.count() == 0) return;
  cv::Mat filled = bgr.rowRange(inside.first, inside.end);
  cv::cvtColor(yuyv.rowRange(inside.first, inside.end), filled, cv::COLOR_YUV2BGR_YUYV);
}

}  // namespace telehug
