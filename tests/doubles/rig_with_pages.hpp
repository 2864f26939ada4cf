// SPDX-License-Identifier: Apache-2.0
//
// A rendered rig whose monitor shows the pages of a set-up, and people before it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "calibration/calibration_page.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"
#include "common/clock.hpp"
#include "doubles/perfect_calibration.hpp"
#include "setup/calibration_session.hpp"
#include "setup/page_pictures.hpp"

namespace telehug {

class RigWithPages {
 public:
  explicit RigWithPages(const VirtualRigSettings& settings) : settings_(settings), renderer_(settings) {}

  // The same page and hand give one of three pictures, which differ in their noise.
  const cv::Mat& picture(SetupPage page, const std::vector<ScreenPoint>& dots, const std::optional<HandPose>& hand) {
    const unsigned noise = ++pictures_ % 3;
    const ScreenPoint dot = dots.empty() ? ScreenPoint{} : dots.front();
    const FingerPlace finger = hand ? hand->finger : FingerPlace{{-1, -1}, -1};
    const double approach_deg = hand ? hand->approach_deg : 0;
    const Key key{page, dot.x_mm, dot.y_mm, finger.foot.x_mm, finger.foot.y_mm, finger.hover_mm, approach_deg, noise};
    constexpr std::size_t most_known = 600;
    if (known_.size() == most_known) known_.clear();
    cv::Mat& bgr = known_[key];
    if (!bgr.empty()) return bgr;
    if (shown_ != std::tuple(page, dot.x_mm, dot.y_mm)) {
      renderer_.show(page_picture(page, dots));
      shown_ = {page, dot.x_mm, dot.y_mm};
    }
    renderer_.draw(hand ? std::vector<HandPose>{*hand} : std::vector<HandPose>{}, pictures_, bgr);
    return bgr;
  }

  [[nodiscard]] const VirtualRigSettings& settings() const { return settings_; }

  // Mean and largest error of a solved camera over the places that the rig's camera sees, mm.
  struct Errors {
    ScreenPoint mean;
    ScreenPoint largest;
  };
  [[nodiscard]] Errors errors(const RigCalibration& solved) const {
    const RigCamera truth = camera_of(settings_);
    Errors errors;
    int places = 0;
    for (double x = 0.02; x < 1; x += 0.04) {
      for (double y = 0.4; y < 1; y += 0.1) {
        const ScreenPoint at{x * settings_.screen.width_mm, y * settings_.screen.height_mm};
        if (!truth.sees(at)) continue;
        const auto placed = solved.solution.model.camera.screen_point(*truth.project(at));
        const double dx = placed ? std::abs(placed->x_mm - at.x_mm) : 1e9;
        const double dy = placed ? std::abs(placed->y_mm - at.y_mm) : 1e9;
        errors.mean = {errors.mean.x_mm + dx, errors.mean.y_mm + dy};
        errors.largest = {std::max(errors.largest.x_mm, dx), std::max(errors.largest.y_mm, dy)};
        ++places;
      }
    }
    errors.mean = {errors.mean.x_mm / places, errors.mean.y_mm / places};
    return errors;
  }

 private:
  using Key = std::tuple<SetupPage, double, double, double, double, double, double, unsigned>;

  [[nodiscard]] cv::Mat page_picture(SetupPage page, const std::vector<ScreenPoint>& dots) const {
    if (page == SetupPage::triangle) return triangle_picture(settings_.screen);
    if (page == SetupPage::marks) return dots_picture(settings_.screen, mark_points(settings_.screen));
    return dots_picture(settings_.screen, page == SetupPage::dot ? dots : std::vector<ScreenPoint>());
  }

  VirtualRigSettings settings_;
  RigRenderer renderer_;
  std::map<Key, cv::Mat> known_;
  std::tuple<SetupPage, double, double> shown_{SetupPage::none, 0, 0};
  unsigned pictures_ = 0;
};

// What somebody does, by what the session asks for and how long it has asked for it; nothing: nobody is there.
using Person = std::function<std::optional<HandPose>(const SetupState& state, double asked_s)>;

inline HandPose pointing_at(const ScreenPoint& place, double hover_mm = 0) {
  HandPose hand;
  hand.finger = {place, hover_mm};
  return hand;
}

// Needs 2.2 s to lay a finger on a dot, keeps it there trembling by 0.3 mm, and leaves within 0.6 s when it is taken.
// `beside_mm` to the right of the dot, `swing_mm` to both sides of that.
inline Person touching_person(double beside_mm = 0, double swing_mm = 0) {
  return [=](const SetupState& state, double asked_s) -> std::optional<HandPose> {
    if (state.step != SetupStep::dots) return std::nullopt;
    constexpr double leave_s = 0.6, comes_s = 1.4, touch_s = 2.2;
    if (asked_s < leave_s && state.dot > 0) {
      return asked_s < leave_s / 2 ? std::optional(pointing_at(state.dots[state.dot - 1]))
                                   : std::optional(pointing_at(state.dots[state.dot - 1], 60));
    }
    if (asked_s < comes_s) return std::nullopt;
    const ScreenPoint dot = state.dots[state.dot];
    const int step = static_cast<int>(std::floor(asked_s * 30));
    if (asked_s < touch_s) return pointing_at(dot, std::max(5.0, std::round((touch_s - asked_s) * 10) * 8));
    constexpr std::array tremor_mm{-0.3, 0.0, 0.3, 0.0};
    const double swing = swing_mm * std::round(3 * std::sin(step * 0.8)) / 3;
    return pointing_at({dot.x_mm + beside_mm + swing + tremor_mm[static_cast<std::size_t>(step / 3 % 4)], dot.y_mm});
  };
}

// The set-up of one rig by one person at 30 frames/s, with a monitor and a camera that are four frames late.
class RenderedSetUp {
 public:
  RenderedSetUp(RigWithPages& rig, CalibrationSession& session) : rig_(rig), session_(session) {}

  // Until `ended` or for `most_frames`; true: it has ended.
  bool run(const Person& person, const std::function<bool(const SetupState&)>& ended, int most_frames) {
    for (int i = 0; i < most_frames; ++i) {
      if (ended(session_.state())) return true;
      step(person);
    }
    return ended(session_.state());
  }

  void step(const Person& person) {
    const SetupState& state = session_.state();
    if (state.step != asked_step_ || state.dot != asked_dot_) {
      asked_step_ = state.step;
      asked_dot_ = state.dot;
      asked_frame_ = frames_;
    }
    shown_.push_back(
        {state.page, state.page == SetupPage::dot ? std::vector{state.dots[state.dot]} : std::vector<ScreenPoint>()});
    const Shown& late = shown_[shown_.size() > 4 ? shown_.size() - 5 : 0];
    const double asked_s = static_cast<double>(frames_ - asked_frame_) / 30;
    rig_.picture(late.page, late.dots, person(state, asked_s)).copyTo(picture_);
    if (upside_down) cv::rotate(picture_, picture_, cv::ROTATE_180);
    if (mirrored) cv::flip(picture_, picture_, 1);
    ++frames_;
    session_.look(picture_, from_ns(1'000'000'000 + frames_ * 33'333'333) + passed_);
    said.insert(name_of(session_.state().advice));
  }

  // Nothing is seen meanwhile.
  void pass(Duration time) { passed_ += time; }

  // The last one that the session has seen.
  [[nodiscard]] const cv::Mat& picture() const { return picture_; }
  [[nodiscard]] double seconds() const { return static_cast<double>(frames_) / 30; }

  std::set<std::string> said;  // every advice so far
  bool upside_down = false;
  bool mirrored = false;

 private:
  struct Shown {
    SetupPage page;
    std::vector<ScreenPoint> dots;
  };

  RigWithPages& rig_;
  CalibrationSession& session_;
  std::vector<Shown> shown_;
  SetupStep asked_step_ = SetupStep::bright;
  std::size_t asked_dot_ = 0;
  std::int64_t asked_frame_ = 0;
  std::int64_t frames_ = 0;
  Duration passed_{};
  cv::Mat picture_;
};

}  // namespace telehug
