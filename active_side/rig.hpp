// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "active_pipeline.hpp"
#include "common/result.hpp"
#include "config/config.hpp"
#include "face_worker.hpp"

namespace telehug {

// What a calibration brings to life: the touch path of its camera and screen, and the face on that screen.
struct Rig {
  ActivePipeline pipeline;
  std::shared_ptr<FaceWorker> face;
  std::string detector;    // "thesis" or "default"
  std::string model;       // of the calibration, likewise
  std::string calibrated;  // when: ISO 8601, UTC
  // Outline of the part of the screen on which the camera sees touches; null: the calibration does not tell.
  std::shared_ptr<const std::vector<ScreenPoint>> reach;
  std::string face_note;  // why faces are not found as configured; may be empty
  std::string note;       // that, and what else works but could be better; may be empty
};

// The error says what is wrong with the calibration, with the configuration for it, or with the face finder, and what
// to do. `stream`, `clock` and `metrics` outlive the rig. `versions_after`: body maps of earlier rigs had versions up
// to this one.
Result<std::unique_ptr<Rig>> make_rig(const ActiveConfig& config, TouchStream& stream, const Clock& clock,
                                      MetricsRegistry& metrics, std::uint32_t versions_after);

}  // namespace telehug
