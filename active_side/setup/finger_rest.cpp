// SPDX-License-Identifier: Apache-2.0
#include "setup/finger_rest.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

constexpr std::size_t most_places = 64;

double median(const std::vector<ScreenPoint>& points, double ScreenPoint::*coordinate) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const ScreenPoint& point : points)
    values.push_back(point.*coordinate);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void FingerRest::forget() {
  places_.clear();
  frames_ = missed_ = 0;
}

void FingerRest::begin(const ScreenPoint& finger, Timestamp now) {
  forget();
  places_.push_back(finger);
  frames_ = 1;
  since_ = now;
}

std::optional<ScreenPoint> FingerRest::place() const {
  if (places_.empty()) return std::nullopt;
  return ScreenPoint{median(places_, &ScreenPoint::x_mm), median(places_, &ScreenPoint::y_mm)};
}

void FingerRest::look(const std::optional<ScreenPoint>& finger, Timestamp now) {
  now_ = now;
  const auto rest = place();
  if (!rest) {
    if (finger) begin(*finger, now);
    return;
  }
  ++frames_;
  if (finger && std::hypot(finger->x_mm - rest->x_mm, finger->y_mm - rest->y_mm) <= rule_.radius_mm) {
    if (places_.size() == most_places) places_.erase(places_.begin());
    places_.push_back(*finger);
    return;
  }
  ++missed_;
  const double allowed = std::max(1.0, rule_.forgiven * static_cast<double>(frames_));
  if (static_cast<double>(missed_) <= allowed) return;
  if (finger) {
    begin(*finger, now);
  } else {
    forget();
  }
}

double FingerRest::progress() const noexcept {
  if (places_.empty()) return 0;
  const double time = std::chrono::duration<double>(now_ - since_) / std::chrono::duration<double>(rule_.rest);
  const double frames = static_cast<double>(places_.size()) / static_cast<double>(rule_.least_frames);
  return std::clamp(std::min(time, frames), 0.0, 1.0);
}

}  // namespace telehug
