// SPDX-License-Identifier: Apache-2.0
#include "body_map/body_map_step.hpp"

#include <utility>

namespace telehug {
namespace {

const char* sentence(NobodyFollowed why) {
  switch (why) {
    case NobodyFollowed::no_face:
      return "No face is seen in the picture of the video chat.";
    case NobodyFollowed::not_sure:
      return "A face may be in the picture of the video chat; it is not sure yet.";
    case NobodyFollowed::still:
      return "The face in the picture of the video chat never moves: it is a picture of somebody, not somebody.";
    case NobodyFollowed::refused:
      return "The faces in the picture of the video chat are too small, in a corner like the own picture, or not where "
             "a face is pinned.";
  }
  return "";
}

}  // namespace

BodyMapStep::BodyMapStep(ScreenGrabber& grabber, FaceFinder& finder, const BodyMapStepConfig& config)
    : grabber_(grabber),
      finder_(finder),
      config_(config),
      follower_(config.rules, grabber.is_live()),
      tracker_(config.tracker, config.mirrored) {}

const BodyMap& BodyMapStep::run() {
  const GrabOutcome outcome = grabber_.grab(picture_);
  in_front_ = outcome == GrabOutcome::lost ? std::nullopt : picture_.in_front;
  switch (outcome) {
    case GrabOutcome::unchanged:
      return searched_ ? lay(follower_.unchanged(picture_.time)) : search();
    case GrabOutcome::lost:
      return lose(grabber_.last_error());
    case GrabOutcome::changed:
      break;
  }
  searched_ = false;
  return search();
}

void BodyMapStep::rest() {
  follower_.rest();
  tracker_.update(picture_.time, std::nullopt, {});
  in_front_.reset();
  problem_.clear();
}

const BodyMap& BodyMapStep::search() {
  notice_another_view();
  const auto faces = finder_.find(picture_.bgr);
  if (!faces) return lose(faces.error().message);
  searched_ = true;
  return lay(follower_.look(picture_.time, picture_.bgr, *faces));
}

// In another size what was where before says nothing. In a window that was moved everybody is where they were, but the
// grid is not.
void BodyMapStep::notice_another_view() {
  const cv::Rect view(picture_.origin_px, picture_.bgr.size());
  const bool same_size = view.size() == view_px_.size() && picture_.monitor.width_px == view_monitor_.width_px &&
                         picture_.monitor.height_px == view_monitor_.height_px;
  if (!same_size) follower_.start_anew();
  if (view != view_px_) tracker_.leap_next();
  view_px_ = view;
  view_monitor_ = picture_.monitor;
}

const BodyMap& BodyMapStep::lay(const std::optional<FollowedFace>& followed) {
  const auto scale = this->scale();
  if (!scale) {
    problem_ = scale.error().message;
    return tracker_.update(picture_.time, std::nullopt, {});
  }
  std::optional<MappedFace> face;
  if (followed) {
    const cv::Point2d origin = view_px_.tl();
    face = MappedFace{followed->person, scale->to_mm(followed->box + origin), followed->seen};
  }
  const BodyMap& map = tracker_.update(picture_.time, face, scale->to_mm(cv::Rect2d(view_px_)));
  problem_.clear();
  if (!followed || followed->seen != picture_.time) {
    problem_ = sentence(follower_.why_nobody());
  } else if (map.version == 0) {
    problem_ = "A face is seen in the video chat, but nothing of the body below it.";
  }
  return map;
}

Result<ScreenScale> BodyMapStep::scale() const {
  if (!config_.screen) return ScreenScale{.mm_per_px_x = 1, .mm_per_px_y = 1};
  return make_screen_scale(*config_.screen, view_monitor_);
}

// A hand in front of a face is waited for, but nobody is touched on a screen that is not seen.
const BodyMap& BodyMapStep::lose(std::string why) {
  follower_.blind(picture_.time);
  problem_ = std::move(why);
  return tracker_.update(picture_.time, std::nullopt, {});
}

}  // namespace telehug
