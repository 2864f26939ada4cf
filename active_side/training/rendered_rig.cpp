// SPDX-License-Identifier: Apache-2.0
#include "rendered_rig.hpp"

#include <array>

#include "calibration/border_curve.hpp"
#include "capture/virtual_rig/random_numbers.hpp"

namespace telehug {
namespace {

constexpr std::array kinds{FrameKind::touch, FrameKind::hover, FrameKind::touch,     FrameKind::two_fingers,
                           FrameKind::hover, FrameKind::palm,  FrameKind::two_hands, FrameKind::touch,
                           FrameKind::hover, FrameKind::away,  FrameKind::palm,      FrameKind::two_fingers,
                           FrameKind::palm};

RandomRig drawn(std::uint64_t seed) {
  RandomRig rig = random_rig(seed);
  RandomNumbers random(seed + 99);
  rig.settings.sensor.jpeg_quality = random.chance(0.8) ? static_cast<int>(random.uniform(60, 96)) : 0;
  // Two of its screen contents, so that little time goes into views.
  const std::size_t first = 1 + random.index(rig.contents.size() - 1);
  if (random.chance(0.4)) {
    rig.settings.light.contact_shade = random.uniform(0.1, 0.9);
    rig.settings.light.contact_shade_mm = random.uniform(0.7, 6);
  }
  rig.contents = {random.chance(0.3) ? ScreenContent::black : rig.contents[first]};
  return rig;
}

RigCamera camera_of(const VirtualRigSettings& s) {
  const RigPoint& at = s.camera.position_mm;
  return {{s.focal_px, s.distortion_k1, {at[0], at[1], at[2]}, s.camera.pitch_deg, s.camera.yaw_deg, s.camera.roll_deg},
          s.image};
}

}  // namespace

RenderedRig::RenderedRig(std::uint64_t seed, const std::vector<cv::Mat>& pictures)
    : rig_(drawn(seed)), camera_(camera_of(rig_.settings)) {
  RandomNumbers random(seed + 1234);
  if (!pictures.empty()) {
    const cv::Mat& whole = pictures[random.index(pictures.size())];
    const double share = random.uniform(0.35, 1);
    const int width = static_cast<int>(share * whole.cols);
    const int height = static_cast<int>(share * whole.rows);
    const int left = static_cast<int>(random.uniform(0, whole.cols - width));
    const int top = static_cast<int>(random.uniform(0, whole.rows - height));
    picture_ = whole(cv::Rect(left, top, width, height)).clone();
  }
  VirtualRigSettings black = rig_.settings;
  black.content = ScreenContent::black;
  renderer_ = std::make_unique<RigRenderer>(black);
  views_[-1] = renderer_->view();
}

cv::Mat RenderedRig::background() {
  cv::Mat bgr;
  renderer_->show(views_[-1]);
  renderer_->draw(std::vector<HandPose>{}, 1, bgr);
  return bgr;
}

std::shared_ptr<RigView> RenderedRig::view_of(const RandomFrame& frame, bool picture) {
  auto& view = views_[picture ? -2 : static_cast<int>(frame.content)];
  if (!view) {
    VirtualRigSettings showing = rig_.settings;
    if (picture) showing.screen_picture = picture_;
    showing.content = frame.content;
    view = renderer_->view(showing);
  }
  return view;
}

// Few of the hovering fingers that are drawn at random look as if they touched; those are what there is to learn from.
RandomFrame RenderedRig::random_picture(FrameKind kind, std::uint64_t seed) const {
  constexpr std::uint64_t attempts = 40;
  const BorderCurve border(camera_, screen());
  RandomFrame frame = random_frame(rig_, kind, seed);
  for (std::uint64_t i = 1; kind == FrameKind::hover && seed % 5 != 0 && i < attempts; ++i) {
    const FingerPlace& finger = frame.hands.front().finger;
    const auto place = camera_.project(RigVector{finger.foot.x_mm, finger.foot.y_mm, finger.hover_mm});
    if (place && place->v_px > border.v_at(place->u_px)) break;
    frame = random_frame(rig_, kind, seed + i * 1'000'000'007);
  }
  return frame;
}

RenderedFrame RenderedRig::frame(std::uint64_t index) {
  const std::uint64_t seed = rig_.settings.seed * 1000 + index;
  RandomFrame drawn = random_picture(kinds[index % kinds.size()], seed);
  // Fingers that lie on their side, long nails and gloves are seldom, and hardest to see through.
  RandomNumbers random(seed + 5);
  for (HandPose& hand : drawn.hands) {
    if (random.chance(0.5)) hand.turn_deg = random.uniform(-100, 100);
    if (random.chance(0.3)) hand.approach_deg = random.uniform(hand.approach_deg, 86);
    if (random.chance(0.3) && hand.posture == Posture::pointing && !hand.second)
      hand.lean_deg += random.uniform(-20, 20);
    if (random.chance(0.3))
      hand.looks->polish = cv::Vec3d(random.uniform(0, 255), random.uniform(0, 255), random.uniform(0, 255));
    if (random.chance(0.25)) hand.looks->nail_mm = random.uniform(3, 12);
    if (random.chance(0.12)) hand.looks->sleeve = Sleeve::glove;
    // Real fingertips differ in shape and in how hard they press; what the net should go by is the picture, not a
    // shape.
    hand.looks->tip_radius_mm = random.uniform(5, 7.8);
    hand.looks->tip_flatness = random.uniform(0.72, 1);
    hand.looks->nail_width = random.uniform(0.6, 0.9);
    if (random.chance(0.4)) {
      hand.looks->pulp_mm = random.uniform(0, 1.6);
      hand.looks->pulp_side_mm = random.uniform(-2.5, 2.5);
    }
    hand.press_mm = random.uniform(0.02, 0.6);
  }
  RenderedFrame frame;
  renderer_->show(view_of(drawn, !picture_.empty() && index % 2 == 1));
  renderer_->draw(drawn.hands, seed, frame.bgr);
  const BorderCurve border(camera_, screen());
  const auto add = [&](const FingerPlace& finger, const HandLooks& looks) {
    const RigVector tip{finger.foot.x_mm, finger.foot.y_mm, finger.hover_mm};
    const auto place = camera_.project(tip);
    const auto beside = camera_.project(RigVector{tip.x_mm + 1, tip.y_mm, tip.z_mm});
    if (!place || !beside) return;
    const double px_per_mm = std::hypot(beside->u_px - place->u_px, beside->v_px - place->v_px);
    frame.tips.push_back({*place, place->v_px > border.v_at(place->u_px), finger.hover_mm <= 0, finger.hover_mm,
                          looks.finger_width_mm * px_per_mm});
  };
  for (const HandPose& hand : drawn.hands) {
    if (hand.posture != Posture::pointing) continue;
    add(hand.finger, *hand.looks);
    if (hand.second) add(*hand.second, *hand.looks);
  }
  return frame;
}

}  // namespace telehug
