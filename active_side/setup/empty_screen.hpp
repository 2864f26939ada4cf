// SPDX-License-Identifier: Apache-2.0
//
// The steps of a set-up in which nobody is there: the screen's edge, the background, the page of marks.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "calibration/screen_border.hpp"
#include "common/clock.hpp"
#include "setup/marks_camera.hpp"
#include "setup/setup_state.hpp"
#include "setup/still_picture.hpp"

namespace telehug {

// What they have found. Pictures are as the camera delivers them.
struct EmptyScreen {
  ScreenSize screen;
  bool upside_down = false;  // the triangle was found in the picture that is turned
  ScreenBorder border;       // in turned pictures, if so; without a vertex if no triangle was seen
  cv::Mat triangle;
  cv::Mat black;
  cv::Mat marks;                        // empty: not looked at
  std::vector<RigCalibration> cameras;  // of turned pictures, the likeliest first; none: the marks were not seen

  // The picture with the screen below its border.
  [[nodiscard]] cv::Mat turned(const cv::Mat& bgr) const;
};

enum class LookOutcome { wait, done, back };

class EmptyScreenSteps {
 public:
  // `may_be_upside_down`: pictures are also tried upside down.
  EmptyScreenSteps(const ScreenSize& screen, bool may_be_upside_down);

  // Each of them looks at one more picture and says in `state` what it sees and what is missing. Before another step is
  // begun: forget().
  LookOutcome look_bright(const cv::Mat& bgr, Timestamp now, SetupState& state);
  LookOutcome look_confirm(const cv::Mat& bgr, SetupState& state);  // back: the camera has moved
  // back: there is no triangle, and where the screen should be nothing became black
  LookOutcome look_background(const cv::Mat& bgr, Timestamp now, SetupState& state);
  LookOutcome look_marks(const cv::Mat& bgr, Timestamp now, SetupState& state);  // back: somebody was in the background
  void forget();

  [[nodiscard]] const EmptyScreen& seen() const noexcept { return seen_; }

 private:
  void find_border(const cv::Mat& bgr, SetupState& state);
  void tell_border(SetupState& state) const;
  void find_cameras();
  [[nodiscard]] bool sees_black(const cv::Mat& bgr) const;

  EmptyScreen seen_;
  bool may_be_upside_down_;
  StillPicture still_;
  int looks_ = 0;
  bool border_found_ = false;          // any line
  cv::Mat white_fields_;               // turned: the picture with the white page in fields
  int tries_ = 0;                      // of finding marks
  std::optional<Timestamp> asked_at_;  // for the black page
  int backgrounds_ = 0;                // that were taken
};

}  // namespace telehug
