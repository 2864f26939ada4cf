// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "capture/virtual_rig/random_rig.hpp"
#include "common/result.hpp"

namespace telehug {

// After so many single pictures, and hard ones, the kinds of frames come again.
inline constexpr int frame_kinds_by_turns = 13;
inline constexpr int hard_kinds_by_turns = 2;

struct ExportSettings {
  int calibration_touches = 9;  // of calibration_points(), from the first on
  int sequence_frames = 120;    // how much of the script, from its beginning, becomes `sequence`; 0: none
  int single_frames = 12;  // random touches, hovering fingers, distant hands and empty pictures in `frames`; 0: none
  int hard_frames = 4;     // random touches of two fingers or two hands in `hard`; 0: none
  // How many of the rig's endless row of frames (and of hard ones) are left out before the first. Names go on with the
  // row: a part of it is the same pictures under the same names.
  int skipped_frames = 0;
  int skipped_hard_frames = 0;
};

// Writes a recording of a virtual rig (layout: rig_directory.hpp) with its truth: rig.toml, background, triangle,
// marks, calibration, frames, hard, sequence, times.csv. The notes of a hovering finger's single picture say "mirrored"
// where its mirror image can be seen (mirror_contrast.hpp). The folder may exist; files of the same names are replaced.
Status export_rig_directory(const VirtualRigSettings& rig, const std::filesystem::path& path,
                            const ExportSettings& settings = {});

// The same with the rig's users and screen contents in turn; its groups go into rig.toml.
Status export_rig_directory(const RandomRig& rig, const std::filesystem::path& path,
                            const ExportSettings& settings = {});

}  // namespace telehug
