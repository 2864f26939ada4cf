// SPDX-License-Identifier: Apache-2.0
//
// The dots of a set-up, touched one after the other.
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "calibration/thesis_touch_model.hpp"
#include "common/clock.hpp"
#include "setup/empty_screen.hpp"
#include "setup/finger_rest.hpp"
#include "setup/setup_state.hpp"
#include "setup/still_picture.hpp"
#include "setup/touch_watch.hpp"

namespace telehug {

// A finger this near to its dot is on it: of the touches in finger_rest.hpp the tip net misplaced two by more than 8
// mm.
inline constexpr double on_dot_mm = 10;

struct DotSettings {
  bool thesis = false;
  std::size_t count = 9;            // of dots that are planned
  std::vector<ScreenPoint> points;  // instead, if any
};

class DotTouches {
 public:
  DotTouches(const EmptyScreen& seen, const DotSettings& settings);

  // True: all that are to be touched are.
  bool look(const cv::Mat& bgr, Timestamp now, SetupState& state);

  bool back();                   // the last one taken is to be touched again; false: none was
  bool skip();                   // the one that is shown; false: fewer than two would be left
  bool repeat(std::size_t dot);  // one that was taken or skipped
  [[nodiscard]] bool can_skip() const noexcept;

  [[nodiscard]] bool all_taken() const noexcept;
  [[nodiscard]] bool camera_known() const noexcept { return camera_.has_value(); }
  [[nodiscard]] const std::vector<ScreenPoint>& dots() const noexcept { return dots_; }
  [[nodiscard]] std::vector<bool> taken() const;
  [[nodiscard]] std::size_t dot() const noexcept { return dot_; }  // the one that is shown
  // As the camera delivered it; of dots that were taken.
  [[nodiscard]] const cv::Mat& picture(std::size_t dot) const { return touches_.at(dot).picture; }
  [[nodiscard]] const MeasuredTouch& measured(std::size_t dot) const { return touches_.at(dot).measured; }

 private:
  struct Touch {
    cv::Mat picture;
    MeasuredTouch measured;  // thesis
    bool taken = false;
    bool skipped = false;
  };

  void plan();
  void watch_with(const std::optional<RigCalibration>& camera);
  void begin_dot();
  // Whether the dot is seen where the camera should see it; otherwise another camera may be the right one.
  bool check_camera(const cv::Mat& upright);
  // How the dot and what is beside it look, in a few fields, compared with the whole picture's mean, so that the
  // camera's exposure is in both.
  [[nodiscard]] cv::Mat about_dot(const cv::Mat& upright) const;
  // Something has covered the dot alike for so long that it is a finger, whatever the net says.
  [[nodiscard]] bool covered_for_long(const cv::Mat& upright, const TouchView& view, Timestamp now);
  bool take();
  void advise(const TouchView& view, bool on_dot, SetupState& state) const;

  EmptyScreen seen_;
  DotSettings settings_;
  cv::Mat black_;                              // turned
  std::optional<RigCalibration> camera_;       // what the marks told
  std::vector<RigCalibration> other_cameras_;  // that the marks allow
  bool camera_checked_ = false;
  bool mirrored_tried_ = false;
  int checks_ = 0;
  std::optional<TouchWatch> watch_;
  std::vector<ScreenPoint> dots_;
  std::vector<Touch> touches_;
  std::vector<std::size_t> order_;  // of those that were taken
  std::size_t dot_ = 0;
  FingerRest rest_;
  StillPicture still_;
  std::optional<ScreenPoint> last_place_;  // where the last one was taken: the finger has not left it yet
  int frames_without_finger_ = 0;
  int dot_frames_ = 0;  // since this dot is shown
  cv::Mat free_look_;   // before anybody reached this dot; the sum of some
  cv::Mat covered_look_;
  std::optional<Timestamp> covered_since_;
  Timestamp covered_seen_;
};

}  // namespace telehug
