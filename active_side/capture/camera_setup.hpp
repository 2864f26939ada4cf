// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/camera_controls.hpp"
#include "capture/camera_memory.hpp"

namespace telehug {

enum class CameraPreset {
  keep,   // as the camera is
  fixed,  // "thesis": every automatic off, at what it had arrived at when the camera was opened
  tuned,  // "auto": the automatics off and the settings that `camera tune` found; without those as `keep`
};

struct CameraSetupSettings {
  CameraPreset preset = CameraPreset::keep;
  int power_line_hz = 0;  // 50 or 60: what the light flickers with; 0: as the camera is
  std::filesystem::path tuned_file;
  std::filesystem::path before_file;  // empty: nothing is changed, because it could not be put back
};

// What the settings change in a camera that has these controls, in the order in which to set it: automatics off before
// the values that they ruled. `tuned`: empty if it was not tuned.
[[nodiscard]] ControlValues planned_controls(const CameraSetupSettings& settings,
                                             const std::vector<CameraControl>& controls, const ControlValues& tuned);

// What puts these controls back, in the order in which to set it: values before the automatics that rule them.
[[nodiscard]] ControlValues controls_before(const ControlValues& planned, const std::vector<CameraControl>& controls);

// Sets a camera up while it is used, and puts everything back afterwards. What was set before is written to a file
// before the first change and the file deleted when it was put back: if the program is killed between, or the camera
// unplugged, the file is there when the camera is opened next, and its settings are what is put back.
class CameraSetup {
 public:
  // `calls` outlive it.
  CameraSetup(CameraSetupSettings settings, V4l2Calls& calls) : settings_(std::move(settings)), calls_(calls) {}

  // When the camera was opened. What does not work is told by summary(); the camera works anyway.
  void apply(const std::string& device);

  // Before the camera is closed; idempotent.
  void put_back();

  // For the status: "auto: 7 settings", and what did not work; empty for a camera that is kept as it is.
  [[nodiscard]] const std::string& summary() const noexcept { return summary_; }

 private:
  void complain(const Error& error);

  CameraSetupSettings settings_;
  V4l2Calls& calls_;
  bool changed_ = false;
  std::string summary_;
};

// Puts back what an earlier program left changed, and deletes the file. Done if there is none, with how many settings.
Result<int> put_back_camera(const std::filesystem::path& before_file, V4l2Calls& calls);

}  // namespace telehug
