// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "capture/virtual_rig/virtual_rig.hpp"

namespace telehug {

struct ExportSettings {
  int calibration_touches = 9;  // of calibration_points(), from the first on
  int sequence_frames = 120;    // how much of the script, from its beginning, becomes `sequence`; 0: none
  int single_frames = 12;       // random touches, hovering fingers and empty pictures that become `frames`; 0: none
};

// Writes a recording of a virtual rig (layout: rig_directory.hpp) with its truth: rig.toml, background, triangle,
// calibration, frames, sequence, times.csv. The folder may exist; files of the same names are replaced.
Status export_rig_directory(const VirtualRigSettings& rig, const std::filesystem::path& path,
                            const ExportSettings& settings = {});

}  // namespace telehug
