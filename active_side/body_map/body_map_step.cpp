// SPDX-License-Identifier: Apache-2.0
#include "body_map/body_map_step.hpp"

#include <optional>
#include <utility>

#include "body_map/screen_scale.hpp"
#include "body_map/vitruvian_grid.hpp"

namespace telehug {

BodyMapStep::BodyMapStep(ScreenGrabber& grabber, FaceFinder& finder, const BodyMapStepConfig& config)
    : grabber_(grabber), finder_(finder), config_(config), tracker_(config.tracker) {}

const BodyMap& BodyMapStep::run() {
  switch (grabber_.grab(picture_)) {
    case GrabOutcome::unchanged:
      return tracker_.unchanged(picture_.time);
    case GrabOutcome::lost:
      return lose(grabber_.last_error());
    case GrabOutcome::changed:
      break;
  }
  return search();
}

const BodyMap& BodyMapStep::search() {
  const auto scale = make_screen_scale(config_.screen, picture_.monitor);
  if (!scale) {
    return lose(scale.error().message);
  }
  const auto faces = finder_.find(picture_.bgr);
  if (!faces) {
    return lose(faces.error().message);
  }
  const cv::Size size = picture_.bgr.size();
  const auto found = choose_remote_face(*faces, {.width_px = size.width, .height_px = size.height}, config_.rules);
  const cv::Point2d origin = picture_.origin_px;
  const ScreenRect view = scale->to_mm(cv::Rect2d(origin, cv::Size2d(size)));
  std::optional<ScreenRect> face;
  if (found) {
    face = scale->to_mm(found->box + origin);
  }
  problem_.clear();
  if (!face) {
    problem_ = "No face is seen in the picture of the video chat.";
  } else if (!make_body_map(*face, view.y_mm + view.height_mm)) {
    problem_ = "A face is seen in the video chat, but nothing of the body below it.";
  }
  return tracker_.searched(picture_.time, face, view);
}

const BodyMap& BodyMapStep::lose(std::string why) {
  problem_ = std::move(why);
  return tracker_.lost(picture_.time);
}

}  // namespace telehug
