// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "common/clock.hpp"

namespace telehug {

// What a camera sees, for a page: small, at most ten times a second, and only while somebody asks.
class LiveJpeg {
 public:
  static constexpr int most_columns_px = 640;
  static constexpr Duration least_between = 100ms;
  static constexpr Duration asked_for = 1s;  // so long after the last question pictures are still made

  // `clock` outlives it.
  explicit LiveJpeg(const Clock& clock) : clock_(clock) {}

  // Any thread: the newest as a whole JPEG file; null if there is none yet.
  [[nodiscard]] std::shared_ptr<const std::string> newest();

  // The camera's thread: a CV_8UC3 picture. Costs nothing while nobody asks, else some milliseconds.
  void look(const cv::Mat& bgr);
  // The camera is closed: there is no newest any more.
  void forget();

 private:
  const Clock& clock_;
  std::mutex mutex_;  // guards what follows
  std::optional<Timestamp> asked_;
  std::shared_ptr<const std::string> newest_;
  std::optional<Timestamp> made_;
};

}  // namespace telehug
