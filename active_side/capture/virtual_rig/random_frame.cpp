// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/random_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "capture/virtual_rig/random_numbers.hpp"
#include "capture/virtual_rig/screen_content.hpp"
#include "capture/virtual_rig/touch_script.hpp"

namespace telehug {
namespace {

constexpr std::uint64_t golden = 0x9E3779B97F4A7C15ULL;
constexpr double degree = std::numbers::pi / 180;
constexpr double margin_share = 0.03;       // of the picture, that a fingertip stays inside
constexpr double long_nail_mm = 4;          // from here on the truth's notes call a nail long
constexpr double away_above_border = 0.03;  // of the picture's height
constexpr int attempts = 2000;

class FrameDrawer {
 public:
  FrameDrawer(const RandomRig& rig, std::uint64_t seed)
      : rig_(rig),
        settings_(rig.settings),
        camera_(settings_.camera, settings_.focal_px, settings_.image, settings_.distortion_k1),
        random_(seed * golden + 3),
        user_(rig.users[random_.index(rig.users.size())]),
        seed_(seed) {}

  RandomFrame draw(FrameKind kind) {
    RandomFrame frame;
    frame.kind = kind;
    frame.content = rig_.contents[random_.index(rig_.contents.size())];
    switch (kind) {
      case FrameKind::nohand:
        break;
      case FrameKind::touch:
        frame.hands.push_back(pose({seen_point(0), 0}, user_));
        if (random_.chance(0.3)) stroke(frame.hands.back());
        break;
      case FrameKind::hover: {
        const double hover_mm = random_.uniform(5, 60);
        frame.hands.push_back(pose({seen_point(hover_mm), hover_mm}, user_));
        if (random_.chance(0.5)) come_or_go(frame.hands.back());
        break;
      }
      case FrameKind::away:
        frame.hands.push_back(pose(place_away(), user_));
        break;
      case FrameKind::two_fingers:
        frame.hands.push_back(two_fingers());
        break;
      case FrameKind::two_hands:
        frame.hands = two_hands();
        break;
      case FrameKind::palm:
        frame.hands.push_back(palm());
        break;
    }
    return frame;
  }

 private:
  HandPose pose(const FingerPlace& place, const HandLooks& looks) {
    return random_pose(settings_, looks, place, seed_ * 8 + ++poses_);
  }

  [[nodiscard]] bool seen(const RigPoint& p) const {
    if (camera_.depth_mm(p) < 40) return false;
    const ImagePoint image = camera_.project(p);
    const double margin_u = margin_share * settings_.image.width_px;
    const double margin_v = margin_share * settings_.image.height_px;
    return image.u_px > margin_u && image.u_px < settings_.image.width_px - margin_u && image.v_px > margin_v &&
           image.v_px < settings_.image.height_px - margin_v;
  }

  // As fast as people stroke a screen.
  void stroke(HandPose& hand) { hand.velocity_mm_per_s = {random_.uniform(-250, 250), random_.uniform(-150, 150), 0}; }

  // As in a script: approach_from_mm within approach_s.
  void come_or_go(HandPose& hand) {
    double speed = random_.uniform(0.2, 1) * approach_from_mm / approach_s;
    if (!random_.chance(0.5)) speed = -speed;
    hand.velocity_mm_per_s = {0, 0.2 * speed, speed};
  }

  // A point of the screen above which the camera sees what hovers there, with equal chance everywhere.
  ScreenPoint seen_point(double hover_mm, double from_x_mm = 0, double to_x_mm = 1e9) {
    const double right = std::min(to_x_mm, settings_.screen.width_mm - 5);
    const double left = std::max(from_x_mm, 5.0);
    for (int i = 0; i < attempts; ++i) {
      const double x_mm = random_.uniform(left, right);
      const double y_mm = random_.uniform(0.2, 0.985) * settings_.screen.height_mm;
      if (seen({x_mm, y_mm, hover_mm}) && (hover_mm > 0 || seen({x_mm, y_mm, 0}))) return {x_mm, y_mm};
    }
    return {(left + right) / 2, 0.9 * settings_.screen.height_mm};
  }

  FingerPlace place_away() {
    const double border_above = away_above_border * settings_.image.height_px;
    for (int i = 0; i < attempts; ++i) {
      const double hover_mm = random_.uniform(70, 140);
      const double x_mm = random_.uniform(0.05, 0.95) * settings_.screen.width_mm;
      const double y_mm = random_.uniform(0.6, 1.1) * settings_.screen.height_mm;
      if (!seen({x_mm, y_mm, hover_mm})) continue;
      const double border_v = camera_.project({x_mm, settings_.screen.height_mm, settings_.bezel_raised_mm}).v_px;
      // The ball of the fingertip hangs below its foremost point.
      if (camera_.project({x_mm, y_mm - 8, hover_mm}).v_px < border_v - border_above) return {{x_mm, y_mm}, hover_mm};
    }
    return {{settings_.screen.width_mm / 2, settings_.screen.height_mm}, 120};
  }

  HandPose two_fingers() {
    for (int i = 0; i < attempts; ++i) {
      const ScreenPoint first = seen_point(0);
      const double beside = random_.uniform(20, 40) * user_.finger_width_mm / 16 * (user_.left ? -1 : 1);
      const ScreenPoint second{first.x_mm + beside, first.y_mm + random_.uniform(-12, 4)};
      if (second.x_mm < 5 || second.x_mm > settings_.screen.width_mm - 5 || !seen({second.x_mm, second.y_mm, 0})) {
        continue;
      }
      HandPose hand = pose({first, 0}, user_);
      hand.second = FingerPlace{second, 0};
      hand.lean_deg = std::clamp(hand.lean_deg, -8.0, 15.0);
      return hand;
    }
    return pose({seen_point(0), 0}, user_);
  }

  // A little in front of the bezel, and over the screen as far that it crosses the border in the picture: what is z in
  // front of the screen is seen there where something z / z0 of the way to the camera's height higher lies on it.
  HandPose palm() {
    const double height_mm = settings_.screen.height_mm;
    const double over_screen_mm = settings_.bezel_raised_mm + random_.uniform(0.5, 8);
    const RigPoint& eye = camera_.position_mm();
    const double hidden_mm = (height_mm - eye[1]) * over_screen_mm / eye[2];
    ScreenPoint foot{settings_.screen.width_mm / 2, height_mm - hidden_mm - random_.uniform(5, 30)};
    for (int i = 0; i < attempts; ++i) {
      const double x_mm = random_.uniform(0.1, 0.9) * settings_.screen.width_mm;
      if (!seen({x_mm, foot.y_mm, over_screen_mm})) continue;
      foot.x_mm = x_mm;
      break;
    }
    HandPose hand = pose({foot, over_screen_mm}, user_);
    hand.posture = random_.chance(0.7) ? Posture::fist : Posture::forearm;
    hand.turn_deg = random_.uniform(-60, 60);  // from the thumb's side to the hand's edge
    return hand;
  }

  std::vector<HandPose> two_hands() {
    HandLooks left = user_;
    HandLooks right = user_;
    left.left = true;
    right.left = false;
    right.ring = false;
    const double middle = settings_.screen.width_mm / 2 + random_.uniform(-30, 30);
    const ScreenPoint of_left = seen_point(0, 0, middle - 35);
    const ScreenPoint of_right = seen_point(0, middle + 35);
    return {pose({of_left, 0}, left), pose({of_right, 0}, right)};
  }

  const RandomRig& rig_;
  const VirtualRigSettings& settings_;
  PinholeCamera camera_;
  RandomNumbers random_;
  const HandLooks& user_;
  std::uint64_t seed_;
  std::uint64_t poses_ = 0;
};

}  // namespace

HandPose random_pose(const VirtualRigSettings& rig, const HandLooks& looks, const FingerPlace& place,
                     std::uint64_t seed) {
  RandomNumbers random(seed * golden + 7);
  HandPose pose;
  pose.finger = place;
  pose.looks = looks;
  pose.lean_deg = random.uniform(-12, 30);
  pose.turn_deg = random.uniform(-20, 20);
  pose.bend_deg = random.uniform(-12, 18);
  pose.press_mm = random.uniform(0.05, 0.4);
  // The finger's underside must pass above the bezel.
  const double to_bezel_mm = std::max(1.0, rig.screen.height_mm - place.foot.y_mm);
  const double clearance_mm = rig.bezel_raised_mm + 3 - place.hover_mm;
  const double least_deg = std::atan2(clearance_mm, to_bezel_mm) / degree + 6 + std::max(0.0, pose.bend_deg);
  pose.approach_deg = random.uniform(std::clamp(least_deg, 25.0, 65.0), 70);
  return pose;
}

RandomFrame random_frame(const RandomRig& rig, FrameKind kind, std::uint64_t seed) {
  return FrameDrawer(rig, seed).draw(kind);
}

TouchScript random_gestures(const RandomRig& rig, int count, std::uint64_t seed) {
  RandomNumbers random(seed * golden + 11);
  TouchScript script;
  double time_s = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t touch_seed = seed * 1000 + static_cast<std::uint64_t>(i);
    const bool two = random.chance(0.15);
    const RandomFrame frame = random_frame(rig, two ? FrameKind::two_fingers : FrameKind::touch, touch_seed);
    const HandPose& hand = frame.hands.front();
    ScriptedTouch touch;
    touch.begin_s = time_s + random.uniform(2 * approach_s + 0.1, 2 * approach_s + 0.5);
    touch.end_s = touch.begin_s + random.uniform(0.2, 1.2);
    touch.from = touch.to = hand.finger.foot;
    if (!hand.second && random.chance(0.35)) {
      const RandomFrame other = random_frame(rig, FrameKind::touch, touch_seed + 500);
      const ScreenPoint& to = other.hands.front().finger.foot;
      // At most 100 mm, as a hand strokes.
      const double share =
          std::min(1.0, 100 / std::max(1.0, std::hypot(to.x_mm - touch.from.x_mm, to.y_mm - touch.from.y_mm)));
      touch.to = {touch.from.x_mm + share * (to.x_mm - touch.from.x_mm),
                  touch.from.y_mm + share * (to.y_mm - touch.from.y_mm)};
    }
    touch.pose = hand;
    touch.pose.second.reset();
    if (hand.second) {
      touch.beside =
          ScreenPoint{hand.second->foot.x_mm - hand.finger.foot.x_mm, hand.second->foot.y_mm - hand.finger.foot.y_mm};
    }
    time_s = touch.end_s;
    script.touches.push_back(touch);
  }
  script.length_s = time_s + 2 * approach_s;
  return script;
}

std::vector<TruthRow> truth_of(const RandomFrame& frame, const std::string& name) {
  static constexpr std::array<const char*, 6> tones{"I", "II", "III", "IV", "V", "VI"};
  const auto row_of = [&](const HandPose& hand, const FingerPlace& finger) {
    TruthRow row;
    row.frame = name;
    row.contact = finger.hover_mm <= 0;
    row.screen = finger.foot;
    if (!row.contact) row.hover_mm = finger.hover_mm;
    row.hand = hand.looks->left ? "left" : "right";
    row.tone = tones[static_cast<std::size_t>(hand.looks->skin_tone - 1)];
    row.notes = frame.hands.size() > 1 || hand.second ? "hard" : name_of(frame.kind);
    if (hand.looks->polish) row.notes += " polish";
    if (hand.looks->nail_mm >= long_nail_mm) row.notes += " long nail";
    if (hand.looks->ring) row.notes += " ring";
    if (hand.looks->sleeve == Sleeve::glove) row.notes += " glove";
    if (hand.second) row.notes += " two fingers";
    if (frame.hands.size() > 1) row.notes += " two hands";
    row.screen_picture = name_of(frame.content);
    return row;
  };
  std::vector<TruthRow> rows;
  for (const HandPose& hand : frame.hands) {
    if (hand.posture != Posture::pointing) {
      TruthRow row = row_of(hand, hand.finger);
      row.contact = false;
      row.screen.reset();
      row.hover_mm.reset();
      rows.push_back(row);
      continue;
    }
    rows.push_back(row_of(hand, hand.finger));
    if (hand.second) rows.push_back(row_of(hand, *hand.second));
  }
  if (rows.empty()) {
    TruthRow row;
    row.frame = name;
    row.screen_picture = name_of(frame.content);
    row.notes = "nohand";
    rows.push_back(row);
  }
  return rows;
}

std::string csv_line(const TruthRow& row) {
  const auto number = [](const std::optional<double>& value, int digits) {
    return value ? fmt::format("{:.{}f}", *value, digits) : std::string{};
  };
  const auto x_mm = row.screen ? std::optional(row.screen->x_mm) : std::nullopt;
  const auto y_mm = row.screen ? std::optional(row.screen->y_mm) : std::nullopt;
  return fmt::format("{},{},{},{},{},{},{},{},{}\n", row.frame, row.contact ? 1 : 0, number(x_mm, 2), number(y_mm, 2),
                     number(row.hover_mm, 1), row.hand, row.tone, row.screen_picture, row.notes);
}

std::string_view name_of(FrameKind kind) {
  static constexpr std::array<std::string_view, 7> names{"touch",       "hover",     "away", "nohand",
                                                         "two fingers", "two hands", "palm"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace telehug
