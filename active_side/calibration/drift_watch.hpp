// SPDX-License-Identifier: Apache-2.0
//
// Has the camera moved since it was calibrated? Judged by how the monitor's lower edge has moved in the picture.
//
// The edge is one nearly level line: it shows pitch (all columns move alike) and roll (left and right move apart). It
// can't show yaw, nor tell pitch from a camera that has slid. A small shift is taken for a rotation, because that
// never makes touches worse: were it a slide, a rotation would still put the border right, and the places above it less
// wrong than they were. A large shift is not corrected: what turned the camera that far turned it sideways, too. The
// state `moved` therefore stays, even if the border comes back.
#pragma once

#include "calibration/border_measurer.hpp"
#include "calibration/rig_model.hpp"
#include "common/clock.hpp"

namespace telehug {

struct DriftOptions {
  double steady_px = 1.2;     // smaller shifts are noise and the light of hands and screens on the bezel
  double moved_px = 3;        // larger ones are not corrected
  double release_part = 0.6;  // a state is left for a lesser one below this part of its limit
  Duration confirm = 1500ms;  // how long a shift must last to be believed
  Duration unseen_after = 10s;
};

enum class DriftState {
  steady,
  moved_slightly,  // corrected
  moved,           // touches mean nothing: calibrate again
  unseen,          // the border has not been seen for long: dark, covered, or the camera looks elsewhere
};

// One sentence for the status; empty while it is steady.
[[nodiscard]] const char* drift_text(DriftState state) noexcept;

struct Drift {
  DriftState state = DriftState::steady;
  double middle_px = 0;  // shift of the border in the picture's middle, the newest
  double edges_px = 0;   // and of its right edge more than that
  double pitch_deg = 0;  // to add to the calibrated camera's; 0 unless `moved_slightly`
  double roll_deg = 0;
};

class DriftWatch {
 public:
  DriftWatch(const RigCamera& camera, const ScreenSize& screen, const DriftOptions& options = {});

  // `now` never decreases. The result lives until the next call. Allocates nothing.
  const Drift& update(const BorderShifts& shifts, Timestamp now);

  // The calibrated camera, turned by the newest correction.
  [[nodiscard]] RigCamera corrected_camera() const;

 private:
  struct Line {
    double middle_px;
    double edges_px;
  };
  [[nodiscard]] static bool fit(const BorderShifts& shifts, double width_px, Line& line);
  [[nodiscard]] DriftState wanted(double size_px) const;
  void correct(const Line& line);

  RigCamera camera_;
  DriftOptions options_;
  // Rows by which a degree of pitch or roll moves the border in the middle, and at the right edge more than that.
  Line by_pitch_;
  Line by_roll_;
  Drift drift_;
  DriftState candidate_ = DriftState::steady;
  Timestamp candidate_since_{};
  Timestamp last_seen_{};
  bool begun_ = false;
};

}  // namespace telehug
