// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/touch_script.hpp"

#include <algorithm>

#include "capture/virtual_rig/random_numbers.hpp"

namespace telehug {
namespace {

// The part of the screen where touches are played, as shares of its width and height. Further up the webcam sees less
// and less of it, and near the lower border only the tip of a finger reaches past it.
constexpr double left = 0.32;
constexpr double right = 0.68;
constexpr double top = 0.56;
constexpr double bottom = 0.86;

// The finger leans back a little while it leaves.
constexpr double drop_per_hover = 0.2;

ScreenPoint mix(const ScreenPoint& a, const ScreenPoint& b, double share) {
  return {a.x_mm + share * (b.x_mm - a.x_mm), a.y_mm + share * (b.y_mm - a.y_mm)};
}

FingerPlace hovering(const ScreenPoint& over, double share_of_way) {
  const double hover_mm = approach_from_mm * share_of_way;
  return {{over.x_mm, over.y_mm + drop_per_hover * hover_mm}, hover_mm};
}

FingerPlace place_in(const ScriptedTouch& touch, double time_s) {
  if (time_s < touch.begin_s) return hovering(touch.from, (touch.begin_s - time_s) / approach_s);
  if (time_s > touch.end_s) return hovering(touch.to, (time_s - touch.end_s) / approach_s);
  const double share = touch.end_s > touch.begin_s ? (time_s - touch.begin_s) / (touch.end_s - touch.begin_s) : 0;
  return {mix(touch.from, touch.to, share * share * (3 - 2 * share)), 0};
}

cv::Vec3d velocity_in(const ScriptedTouch& touch, double time_s) {
  constexpr double half_step_s = 1e-3;
  const FingerPlace before = place_in(touch, time_s - half_step_s);
  const FingerPlace after = place_in(touch, time_s + half_step_s);
  return cv::Vec3d(after.foot.x_mm - before.foot.x_mm, after.foot.y_mm - before.foot.y_mm,
                   after.hover_mm - before.hover_mm) *
         (1 / (2 * half_step_s));
}

const ScriptedTouch* touch_at(const TouchScript& script, double time_s) {
  for (const ScriptedTouch& touch : script.touches) {
    if (time_s >= touch.begin_s - approach_s && time_s <= touch.end_s + approach_s) return &touch;
  }
  return nullptr;
}

}  // namespace

std::optional<FingerPlace> finger_at(const TouchScript& script, double time_s) {
  const ScriptedTouch* touch = touch_at(script, time_s);
  if (touch == nullptr) return std::nullopt;
  return place_in(*touch, time_s);
}

std::vector<HandPose> hands_at(const TouchScript& script, double time_s) {
  const ScriptedTouch* touch = touch_at(script, time_s);
  if (touch == nullptr) return {};
  std::vector<HandPose> hands(1, touch->pose);
  HandPose& pose = hands.front();
  pose.finger = place_in(*touch, time_s);
  pose.velocity_mm_per_s = velocity_in(*touch, time_s);
  if (touch->beside) {
    pose.second = pose.finger;
    pose.second->foot.x_mm += touch->beside->x_mm;
    pose.second->foot.y_mm += touch->beside->y_mm;
  }
  return hands;
}

TouchScript default_script(const ScreenSize& screen) {
  const auto at = [&](double x_share, double y_share) {
    return ScreenPoint{x_share * screen.width_mm, y_share * screen.height_mm};
  };
  TouchScript script;
  const auto add = [&](double gap_s, double length_s, ScreenPoint from, ScreenPoint to) {
    const double begin_s = (script.touches.empty() ? 0 : script.touches.back().end_s) + gap_s;
    script.touches.push_back({begin_s, begin_s + length_s, from, to});
  };
  add(0.8, 0.5, at(0.42, 0.63), at(0.42, 0.63));
  add(0.8, 0.5, at(0.58, 0.63), at(0.58, 0.63));
  add(0.8, 0.5, at(0.50, 0.80), at(0.50, 0.80));
  add(0.8, 1.5, at(0.50, 0.70), at(0.50, 0.70));
  add(0.8, 1.5, at(0.38, 0.66), at(0.62, 0.78));
  script.length_s = script.touches.back().end_s + 0.8;
  return script;
}

TouchScript random_script(const ScreenSize& screen, int count, std::uint64_t seed) {
  RandomNumbers random(seed);
  const auto point = [&] {
    const double x_mm = random.uniform(left, right) * screen.width_mm;
    return ScreenPoint{x_mm, random.uniform(top, bottom) * screen.height_mm};
  };
  TouchScript script;
  double time_s = 0;
  for (int i = 0; i < count; ++i) {
    const double begin_s = time_s + random.uniform(2 * approach_s + 0.1, 2 * approach_s + 0.6);
    time_s = begin_s + random.uniform(0.2, 1.2);
    const ScreenPoint from = point();
    const ScreenPoint to = point();
    const bool stroke = random.uniform(0, 1) < 0.3;
    script.touches.push_back({begin_s, time_s, from, stroke ? to : from});
  }
  script.length_s = time_s + 2 * approach_s;
  return script;
}

}  // namespace telehug
