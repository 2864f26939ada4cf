// SPDX-License-Identifier: Apache-2.0
#include "setup/dot_touches.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "calibration/calibration_page.hpp"
#include "calibration/mark_search.hpp"
#include "setup/dot_plan.hpp"
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

constexpr double margin_px = 12;            // of dots from the picture's sides, in pictures of 1280 columns
constexpr double rough_margin_part = 0.08;  // of the picture's height, where the camera is known to some 20 % only
constexpr double dot_seen_px = 25;          // from where it should be, in pictures of 1280 columns
constexpr double told_apart_px = 45;
constexpr std::size_t most_spots = 4;  // with one dot shown: itself, mirror images and a finger's light
constexpr double left_mm = 15;         // a finger farther from the last dot's place has left it
constexpr int frames_of_leaving = 3;   // or one that is not seen for so long
// Of a dot that is covered by what the net takes for no finger, or places badly.
constexpr Duration patience = 4s;
constexpr Duration short_gap = 70ms;  // two frames, in which it may look different: a hand that shakes comes back later
constexpr double covered_change =
    0.15;  // of how the dot looks; chosen: a finger that was not seen changed its light by 23 %
constexpr double moved_change = 0.12;
constexpr double near_dot_mm = 25;      // a finger that is seen farther away covers nothing
constexpr int frames_until_seen = 8;    // after which the screen shows the dot and the camera has seen it
constexpr int frames_of_reference = 6;  // in which nobody reaches it yet
constexpr int frames_a_camera = 90;     // that a camera which may be the wrong one is given
constexpr Duration moving = 200ms;

double apart(const ScreenPoint& a, const ScreenPoint& b) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm);
}

double apart(const ImagePoint& a, const ImagePoint& b) {
  return std::hypot(a.u_px - b.u_px, a.v_px - b.v_px);
}

}  // namespace

DotTouches::DotTouches(const EmptyScreen& seen, const DotSettings& settings)
    : seen_(seen), settings_(settings), black_(seen.turned(seen.black)) {
  other_cameras_ = seen.cameras;
  std::optional<RigCalibration> likeliest;
  if (!other_cameras_.empty() && !settings.thesis) {
    likeliest = other_cameras_.front();
    other_cameras_.erase(other_cameras_.begin());
  }
  watch_with(likeliest);
}

void DotTouches::watch_with(const std::optional<RigCalibration>& camera) {
  camera_ = camera;
  const ImageSize image{black_.cols, black_.rows};
  const RigModel rough = likely_camera(seen_.border, seen_.screen, image, seen_.upside_down);
  if (settings_.thesis) {
    watch_.emplace(seen_.border.line, rough.camera);
  } else {
    watch_.emplace(as_calibration(camera ? camera->solution.model : rough, seen_.screen), black_);
  }
  plan();
}

void DotTouches::plan() {
  dots_ = settings_.points;
  if (dots_.empty() && settings_.thesis) {
    const auto two = default_calibration_points(seen_.screen);
    dots_.assign(two.begin(), two.end());
  } else if (dots_.empty()) {
    const ImageSize image{black_.cols, black_.rows};
    const double scale = image.width_px / 1280.0;
    const RigModel rough = likely_camera(seen_.border, seen_.screen, image, seen_.upside_down);
    dots_ = plan_dots(camera_ ? camera_->solution.model.camera : rough.camera, seen_.screen, settings_.count,
                      camera_ ? margin_px * scale : rough_margin_part * image.height_px);
  }
  touches_.assign(dots_.size(), {});
  order_.clear();
  begin_dot();
}

void DotTouches::begin_dot() {
  const auto next =
      std::find_if(touches_.begin(), touches_.end(), [](const Touch& t) { return !t.taken && !t.skipped; });
  dot_ = static_cast<std::size_t>(next - touches_.begin());
  rest_.forget();
  still_.forget();
  dot_frames_ = 0;
  free_look_.release();
  covered_since_.reset();
}

bool DotTouches::all_taken() const noexcept {
  return dot_ >= dots_.size();
}

std::vector<bool> DotTouches::taken() const {
  std::vector<bool> taken;
  for (const Touch& touch : touches_)
    taken.push_back(touch.taken);
  return taken;
}

bool DotTouches::back() {
  if (order_.empty()) return false;
  return repeat(order_.back());
}

bool DotTouches::can_skip() const noexcept {
  const auto left = std::count_if(touches_.begin(), touches_.end(), [](const Touch& t) { return !t.skipped; });
  return !settings_.thesis && !all_taken() && left > 2;
}

bool DotTouches::skip() {
  if (!can_skip()) return false;
  touches_[dot_].skipped = true;
  begin_dot();
  return true;
}

bool DotTouches::repeat(std::size_t dot) {
  if (dot >= touches_.size() || (!touches_[dot].taken && !touches_[dot].skipped)) return false;
  touches_[dot] = {};
  order_.erase(std::remove(order_.begin(), order_.end(), dot), order_.end());
  begin_dot();
  dot_ = dot;
  return true;
}

bool DotTouches::check_camera(const cv::Mat& upright) {
  if (!camera_ || camera_checked_) return true;
  const double scale = upright.cols / 1280.0;
  const std::vector<ImagePoint> spots = lit_spots(upright, black_);
  if (spots.size() > most_spots) return false;  // the page of marks is still seen
  const auto where = [&](const RigCalibration& camera) { return camera.solution.model.camera.project(dots_[dot_]); };
  const auto sees = [&](const RigCalibration& camera) {
    const auto at = where(camera);
    return at && std::any_of(spots.begin(), spots.end(),
                             [&](const ImagePoint& spot) { return apart(spot, *at) < dot_seen_px * scale; });
  };
  if (sees(*camera_)) {
    // A dot in the middle looks the same in mirrored pictures, and tells nothing.
    const auto at = where(*camera_);
    const ImagePoint mirrored{upright.cols - 1 - at->u_px, at->v_px};
    camera_checked_ = apart(*at, mirrored) > 2 * told_apart_px * scale;
    return true;
  }
  constexpr int patient_checks = 10;
  if (++checks_ < patient_checks) return false;
  if (!mirrored_tried_) {
    mirrored_tried_ = true;
    const cv::Mat marks = seen_.turned(seen_.marks);
    for (RigCalibration& other : cameras_from_marks({seen_.screen, seen_.border, black_, marks}, !seen_.upside_down))
      other_cameras_.push_back(std::move(other));
  }
  const auto right = std::find_if(other_cameras_.begin(), other_cameras_.end(), sees);
  // Without a triangle this camera may be wrong by a column of marks, and the dot where the right one sees nothing.
  const bool try_next = !seen_.border.vertex && !other_cameras_.empty() && checks_ >= frames_a_camera;
  if (right == other_cameras_.end() && !try_next) return false;
  if (right == other_cameras_.end()) {
    std::rotate(other_cameras_.begin(), other_cameras_.begin() + 1, other_cameras_.end());
    std::swap(other_cameras_.back(), *camera_);
  } else {
    std::swap(*right, *camera_);
  }
  checks_ = 0;
  if (order_.empty()) {
    watch_with(RigCalibration(*camera_));
  } else {
    watch_.emplace(as_calibration(camera_->solution.model, seen_.screen), black_);
  }
  return false;
}

cv::Mat DotTouches::about_dot(const cv::Mat& upright) const {
  constexpr double half_mm = 9;
  constexpr int cells = 6;
  const RigCamera& camera = camera_->solution.model.camera;
  const ScreenPoint& dot = dots_[dot_];
  cv::Mat look = cv::Mat::zeros(cells, cells, CV_32FC3);
  const auto a = camera.project(ScreenPoint{dot.x_mm - half_mm, dot.y_mm - half_mm});
  const auto b = camera.project(ScreenPoint{dot.x_mm + half_mm, dot.y_mm + half_mm});
  if (!a || !b) return look;
  const cv::Rect2d box(cv::Point2d(a->u_px, a->v_px), cv::Point2d(b->u_px, b->v_px));
  const cv::Rect part = cv::Rect(box) & cv::Rect(0, 0, upright.cols, upright.rows);
  if (part.empty()) return look;
  cv::Mat small;
  cv::resize(upright(part), small, {cells, cells}, 0, 0, cv::INTER_AREA);
  const cv::Scalar mean = cv::mean(upright);
  small.convertTo(look, CV_32F, 1 / (mean[0] + mean[1] + mean[2] + 1));
  return look;
}

bool DotTouches::covered_for_long(const cv::Mat& upright, const TouchView& view, Timestamp now) {
  if (!camera_ || ++dot_frames_ <= frames_until_seen) return false;
  const cv::Mat look = about_dot(upright);
  if (dot_frames_ <= frames_until_seen + frames_of_reference) {
    free_look_ = free_look_.empty() ? look.clone() : cv::Mat(free_look_ + look);
    return false;
  }
  const auto change = [&](const cv::Mat& before) {
    return cv::norm(look, before, cv::NORM_L1) / (cv::norm(before, cv::NORM_L1) + 1e-6);
  };
  const bool covered = change(free_look_ / frames_of_reference) > covered_change;
  if (covered && covered_since_ && change(covered_look_) < moved_change) {
    covered_seen_ = now;
    const bool elsewhere = view.finger && apart(*view.finger, dots_[dot_]) > near_dot_mm;
    return now - *covered_since_ >= patience && !elsewhere;
  }
  if (covered_since_ && now - covered_seen_ <= short_gap) return false;
  covered_since_.reset();
  if (!covered) return false;
  covered_since_ = covered_seen_ = now;
  covered_look_ = look;
  return false;
}

bool DotTouches::take() {
  Touch& touch = touches_[dot_];
  touch.picture = still_.picture();
  if (settings_.thesis) {
    (void)watch_->look(touch.picture, dots_[dot_]);
    const auto& finger = watch_->finger();
    if (!finger) return false;
    const ImageSize image{touch.picture.cols, touch.picture.rows};
    touch.measured = {dots_[dot_], finger->length_px, column_from_centre_px(finger->tip.u_px, image)};
  }
  touch.taken = true;
  order_.push_back(dot_);
  return true;
}

void DotTouches::advise(const TouchView& view, bool on_dot, SetupState& state) const {
  state.progress = 0;
  if (last_place_) {
    state.advice = SetupAdvice::next_dot;
  } else if (!rest_.place()) {
    state.advice = SetupAdvice::touch_dot;
  } else if (!on_dot && view.hovers) {
    state.advice = SetupAdvice::finger_hovers;
  } else if (rest_.still_for() < moving) {
    state.advice = SetupAdvice::finger_moves;
  } else if (!on_dot) {
    state.advice = SetupAdvice::finger_beside_dot;
  } else {
    state.advice = SetupAdvice::hold_finger;
    state.progress = rest_.progress();
  }
}

bool DotTouches::look(const cv::Mat& bgr, Timestamp now, SetupState& state) {
  if (all_taken()) return true;
  const cv::Mat upright = seen_.turned(bgr);
  still_.look(bgr, now);
  const TouchView view = watch_->look(upright, dots_[dot_]);
  rest_.look(view.finger, now);
  state.finger_px = view.finger_px;
  if (seen_.upside_down && state.finger_px) state.finger_px->v_px = bgr.rows - 1 - state.finger_px->v_px;
  state.off_mm.reset();

  if (last_place_) {
    frames_without_finger_ = view.finger ? 0 : frames_without_finger_ + 1;
    if (frames_without_finger_ >= frames_of_leaving || (view.finger && apart(*view.finger, *last_place_) > left_mm)) {
      last_place_.reset();
    }
  }
  if (!check_camera(upright)) {
    state.progress = 0;
    state.advice = view.hand_there ? SetupAdvice::hands_away : SetupAdvice::page_not_seen;
    return all_taken();
  }
  const auto place = rest_.place();
  const bool on_dot = place && (!camera_ || apart(*place, dots_[dot_]) <= on_dot_mm);
  if (camera_ && place) state.off_mm = ScreenPoint{place->x_mm - dots_[dot_].x_mm, place->y_mm - dots_[dot_].y_mm};
  const bool after_all = covered_for_long(upright, view, now);
  advise(view, on_dot, state);
  if (last_place_ || !((rest_.rests() && on_dot) || after_all)) return false;
  if (!take()) {
    rest_.forget();
    return false;
  }
  last_place_ = place.value_or(dots_[dot_]);
  frames_without_finger_ = 0;
  ++state.taken;
  state.advice = SetupAdvice::next_dot;
  begin_dot();
  return all_taken();
}

}  // namespace telehug
