// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "body_map/body_map_tracker.hpp"
#include "body_map/choose_remote_face.hpp"
#include "body_map/face_finder.hpp"
#include "screen/screen_grabber.hpp"

namespace telehug {

struct BodyMapStepConfig {
  ScreenSize screen;  // mm; its pixels are the grabber's business
  RemoteFaceRules rules;
  BodyMapTrackerConfig tracker;
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

 private:
  const BodyMap& search();
  const BodyMap& lose(std::string why);

  ScreenGrabber& grabber_;
  FaceFinder& finder_;
  BodyMapStepConfig config_;
  BodyMapTracker tracker_;
  ScreenPicture picture_;
  std::string problem_;
};

}  // namespace telehug
