// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/picture_maker.hpp"

#include <algorithm>
#include <opencv2/core.hpp>

namespace telehug {
namespace {

bool on(const Disturbance& disturbance, double time_s) {
  return time_s >= disturbance.begin_s && time_s < disturbance.end_s;
}

bool changes_view(DisturbanceKind kind) {
  return kind == DisturbanceKind::lights || kind == DisturbanceKind::screen_flash || kind == DisturbanceKind::bump;
}

std::vector<std::size_t> views_changed_at(const std::vector<Disturbance>& disturbances, double time_s) {
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < disturbances.size(); ++i) {
    if (changes_view(disturbances[i].kind) && on(disturbances[i], time_s)) which.push_back(i);
  }
  return which;
}

VirtualRigSettings changed(VirtualRigSettings settings, const Disturbance& disturbance) {
  switch (disturbance.kind) {
    case DisturbanceKind::lights:
      settings.light.level *= disturbance.amount;
      break;
    case DisturbanceKind::screen_flash:
      settings.content = ScreenContent::white;
      settings.motion = ScreenMotion::still;
      settings.screen_picture.release();
      break;
    case DisturbanceKind::bump:
      settings.camera.pitch_deg += disturbance.amount;
      settings.camera.roll_deg += disturbance.amount / 2;
      break;
    case DisturbanceKind::black_frames:
    case DisturbanceKind::torn_frames:
    case DisturbanceKind::frozen:
      break;
  }
  return settings;
}

}  // namespace

PictureMaker::PictureMaker(const VirtualRigSettings& settings)
    : disturbances_(settings.disturbances), renderer_(settings), usual_view_(renderer_.view()) {
  views_[{}] = usual_view_;
  for (const Disturbance& disturbance : disturbances_) {
    for (const double moment_s : {disturbance.begin_s, disturbance.end_s}) {
      const std::vector<std::size_t> which = views_changed_at(disturbances_, moment_s);
      if (views_.contains(which)) continue;
      VirtualRigSettings disturbed = settings;
      for (const std::size_t i : which)
        disturbed = changed(std::move(disturbed), disturbances_[i]);
      views_[which] = renderer_.view(disturbed);
    }
  }
}

void PictureMaker::draw(const std::vector<HandPose>& hands, double time_s, std::uint64_t index, cv::Mat& bgr) {
  const auto frozen = std::any_of(disturbances_.begin(), disturbances_.end(), [&](const Disturbance& disturbance) {
    return disturbance.kind == DisturbanceKind::frozen && on(disturbance, time_s);
  });
  if (frozen && !before_.empty()) {
    before_.copyTo(bgr);
    return;
  }
  renderer_.show(views_.at(views_changed_at(disturbances_, time_s)));
  renderer_.move_screen(time_s);
  renderer_.draw(hands, index, bgr);
  for (const Disturbance& disturbance : disturbances_) {
    if (!on(disturbance, time_s)) continue;
    if (disturbance.kind == DisturbanceKind::black_frames) bgr = cv::Scalar::all(0);
    if (disturbance.kind == DisturbanceKind::torn_frames && !before_.empty()) {
      const cv::Mat whole = bgr.clone();
      const int from = std::clamp(static_cast<int>(disturbance.amount * bgr.rows), 0, bgr.rows);
      before_.rowRange(from, bgr.rows).copyTo(bgr.rowRange(from, bgr.rows));
      before_ = whole;
      return;
    }
  }
  if (!disturbances_.empty()) bgr.copyTo(before_);
}

}  // namespace telehug
