// SPDX-License-Identifier: Apache-2.0
//
// A rig's set-up as a conversation without a person's keyboard: pictures of the camera and the time go in, what to show
// and to say comes out. Pages and the command line drive it alike. It has no thread, waits for nothing and prints
// nothing.
//
//   bright -> confirm_border -> background -> marks -> dots -> solving -> solved -> saved
//
// With nobody there (bright, background, marks) a page is taken when it is seen and nothing has moved for a while. The
// marks tell the camera, so that dots lie where the camera sees them, and how far a finger is from its dot. A dot is
// taken when a finger rests on it (FingerRest). Where no camera could be told, or with the thesis' model, it is taken
// when a finger rests anywhere, having been elsewhere since the last one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "setup/calibrated_rig.hpp"
#include "setup/setup_state.hpp"

namespace telehug {

struct SessionSettings {
  ScreenSize screen;    // mm, both > 0
  bool thesis = false;  // the thesis' model: two dots, no marks
  bool quick = false;   // two dots instead of nine
  std::vector<ScreenPoint>
      points;  // dots instead of the planned ones; two for the thesis' model (else default_calibration_points())
  bool confirm_border = true;  // false: the border that was found is taken
  std::string camera;          // as FrameSource::name() says
  std::string date;            // ISO 8601, UTC
};

class CalibrationSession {
 public:
  // Throws std::invalid_argument if the settings make no calibration.
  explicit CalibrationSession(SessionSettings settings);
  ~CalibrationSession();
  CalibrationSession(CalibrationSession&&) noexcept;
  CalibrationSession& operator=(CalibrationSession&&) noexcept;
  CalibrationSession(const CalibrationSession&) = delete;
  CalibrationSession& operator=(const CalibrationSession&) = delete;

  // A whole picture (CV_8UC3) of the camera; `now` never decreases. Takes some milliseconds; up to a second when a page
  // of marks is looked at, and one or two in the step `solving`: who must not wait, calls it on a thread of its own.
  // Pictures of another size count as none.
  void look(const cv::Mat& bgr, Timestamp now);
  // There was none: after a second the state says so. A session that has not gone on for five minutes ends.
  void no_picture(Timestamp now);

  [[nodiscard]] const SetupState& state() const noexcept;
  [[nodiscard]] const ScreenSize& screen() const noexcept;

  // What the person decides. False, and nothing changes, where it makes no sense (SetupState::can_...).
  bool confirm_border();
  bool look_again();             // the border is another line: begin again
  bool back();                   // to the step before; among dots to the last one taken
  bool skip_dot();               // leave this one out; two at least must be left
  bool repeat(std::size_t dot);  // once solved, or among dots one that was taken
  void cancel();

  // Once solved; the error says why there is none.
  [[nodiscard]] Result<CalibratedRig> calibrated() const;
  // Writes it (save_calibrated_rig()); refuses what is not good enough.
  Status save(const std::filesystem::path& path);

 private:
  class Conversation;
  std::unique_ptr<Conversation> conversation_;
};

}  // namespace telehug
