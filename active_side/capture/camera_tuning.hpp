// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "capture/camera_controls.hpp"
#include "common/clock.hpp"
#include "common/result.hpp"

namespace telehug {

// How well finger and border can be told apart in what the camera sees now, greater is better; made from pictures that
// were taken after the last setting took effect. Nothing: no picture comes at present.
using MeasureScene = std::function<std::optional<double>()>;
using SetControl = std::function<Status(const ControlValue&)>;

// Told after each setting that was tried how much of the search is done, 0 to 1, rising. False ends it.
using TuningProgress = std::function<bool(double)>;

struct TuningOptions {
  Duration longest = 60s;
  int rounds = 2;                // through all controls; in each, the steps are finer
  int steps = 6;                 // over the whole range of a control in the first round
  double least_gain = 0.02;      // a setting must be so much better (part of the score) to be taken: pictures are noisy
  TuningProgress progress = {};  // may be empty
};

struct Tuning {
  ControlValues values;  // the best that were found; they are set
  double before = 0;     // score at the values it began with
  double after = 0;
  int measurements = 0;
  bool complete = false;  // false: the time was over before the search, or it was ended
  bool ended = false;     // by TuningOptions::progress
};

// Those of a camera's controls that make finger and border more or less different: exposure, gain, brightness,
// contrast, saturation; as far as it has them. The exposure (in units of 100 us) is limited to one frame at `fps`: a
// longer one lowers the frame rate and blurs a moving finger.
[[nodiscard]] std::vector<CameraControl> tunable_controls(const std::vector<CameraControl>& controls, double fps);

// Coordinate descent: one control after the other is tried over its range with the others held, and stays at its best;
// a second round with finer steps around it. Exposure is stepped by equal factors, the others by equal distances.
// When no picture comes (the camera was unplugged) it sets everything again and goes on when there is one; the error is
// that none came until the end, or at the beginning none at all.
Result<Tuning> tune_camera(const std::vector<CameraControl>& controls, const SetControl& set,
                           const MeasureScene& measure, const TuningOptions& options, const Clock& clock);

}  // namespace telehug
