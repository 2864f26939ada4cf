// SPDX-License-Identifier: Apache-2.0
#include "rendering/felt_path.hpp"

#include <algorithm>

#include "rendering/geometry.hpp"

namespace telehug {
namespace {

constexpr Duration speed_window = 50ms;
constexpr Duration least_time = 5ms;

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

FeltPath::FeltPath(BodyPoint begin, Timestamp now)
    : place_(finite(begin) ? on_a_body(begin) : begin), at_(now), speed_from_(place_), speed_since_(now) {}

void FeltPath::lead(BodyPoint place, Timestamp now) {
  if (!finite(place)) return;
  const BodyPoint to = on_a_body(place);
  if (!finite(place_)) {
    place_ = speed_from_ = to;
    speed_since_ = now;
    return;
  }
  const BodyPoint before = ahead_.empty() ? place_ : ahead_.back();
  if (ahead_.size() == ahead_.capacity()) ahead_.pop_back();
  if (distance_fh(before, to) > 0) ahead_.push_back(to);

  const Duration passed = now - speed_since_;
  speed_fh_s_ = distance_fh(speed_from_, to) / seconds(std::max(passed, speed_window));
  if (passed < speed_window) return;
  speed_from_ = to;
  speed_since_ = now;
}

double FeltPath::allowance(Pace pace, Timestamp now) {
  const double left_fh = remaining_fh();
  const Duration time_left = arrives_ == Timestamp::max() ? longest_lag : arrives_ - at_;
  const double speed_fh_s = std::max(pace.fh_s, left_fh / seconds(std::max(time_left, least_time)));
  const double allowed_fh = std::min(left_fh_, pace.at_once_fh) + speed_fh_s * seconds(now - at_);
  at_ = now;
  return allowed_fh;
}

double FeltPath::remaining_fh() const {
  double sum_fh = 0;
  BodyPoint from = place_;
  for (const BodyPoint& to : ahead_) {
    sum_fh += distance_fh(from, to);
    from = to;
  }
  return sum_fh;
}

// Returns what is left of the step.
double FeltPath::step_to_next(double step_fh) {
  const double length_fh = distance_fh(place_, ahead_.front());
  if (length_fh > step_fh) {
    place_ = point_between(place_, ahead_.front(), step_fh / length_fh);
    return 0;
  }
  place_ = ahead_.front();
  ahead_.erase(ahead_.begin());
  return step_fh - length_fh;
}

}  // namespace telehug
