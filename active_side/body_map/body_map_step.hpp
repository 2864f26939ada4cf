// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "body_map/body_map_tracker.hpp"
#include "body_map/screen_scale.hpp"
#include "face/face_finder.hpp"
#include "face/remote_face_follower.hpp"
#include "screen/screen_grabber.hpp"

namespace telehug {

struct BodyMapStepConfig {
  std::optional<ScreenSize> screen;  // mm; its pixels are the grabber's business. None: one of 1 mm a pixel
  RemoteFaceRules rules;
  BodyMapTrackerConfig tracker;
  bool mirrored = false;  // the picture shows the remote person as in a mirror
};

// The face step: look at the screen, find the remote face, lay the grid. Runs at its own pace in a thread of its own;
// the grabber must be open.
class BodyMapStep {
 public:
  // `grabber` and `finder` outlive the step.
  BodyMapStep(ScreenGrabber& grabber, FaceFinder& finder, const BodyMapStepConfig& config);

  // One look. A screen that hasn't changed costs no search. Version 0 if there is no map now.
  const BodyMap& run();

  // What the last run returned.
  [[nodiscard]] const BodyMap& map() const { return tracker_.map(); }

  // One sentence for status: why the last run saw no face, even if the map is still held; empty if it saw one.
  [[nodiscard]] const std::string& problem() const { return problem_; }

  // Does the pinned window lie in front? None if no window is pinned, or nothing is seen of the screen.
  [[nodiscard]] std::optional<bool> in_front() const { return in_front_; }

  // Pixels of the monitor that was last looked at; 0x0 at first.
  [[nodiscard]] ImageSize monitor() const { return picture_.monitor; }

  // Of that monitor. Fails if the screen has no size.
  [[nodiscard]] Result<ScreenScale> scale() const;

  // The screen is not looked at for a while. Nothing seen before counts afterwards.
  void rest();

  // By hand: whom to follow. Between runs.
  [[nodiscard]] RemoteFaceFollower& follower() { return follower_; }
  [[nodiscard]] const RemoteFaceFollower& follower() const { return follower_; }

 private:
  const BodyMap& search();
  const BodyMap& lay(const std::optional<FollowedFace>& followed);
  const BodyMap& lose(std::string why);
  void notice_another_view();

  ScreenGrabber& grabber_;
  FaceFinder& finder_;
  BodyMapStepConfig config_;
  RemoteFaceFollower follower_;
  BodyMapTracker tracker_;
  ScreenPicture picture_;
  cv::Rect view_px_;        // the looked-at part of the monitor
  ImageSize view_monitor_;  // and that monitor
  bool searched_ = true;    // was the newest picture?
  std::optional<bool> in_front_;
  std::string problem_;
};

}  // namespace telehug
