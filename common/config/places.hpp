// SPDX-License-Identifier: Apache-2.0
//
// Where the files are that the configuration does not name.
#pragma once

#include <filesystem>

#include "common/messages.hpp"
#include "config/config.hpp"

namespace telehug {

// The calibration file: as configured; else rig.toml in the first of $STATE_DIRECTORY (set by systemd),
// $XDG_STATE_HOME/telehug, /var/lib/telehug (root), ~/.local/state/telehug that applies.
[[nodiscard]] std::filesystem::path rig_file(const RigConfig& config);

// Settings of the camera, beside the calibration file: what `telehug-active camera tune` found, and, while telehug has
// changed some, what they were before.
[[nodiscard]] std::filesystem::path tuned_camera_file(const RigConfig& config);
[[nodiscard]] std::filesystem::path camera_before_file(const RigConfig& config);

// What a Wayland desktop gave to be spared its question for the screen: in the first of the folders named for the
// calibration file, wherever that lies.
[[nodiscard]] std::filesystem::path screen_consent_file();

// The pairs of this PC as one side: as configured, else pairs/active or pairs/passive in the state folder.
[[nodiscard]] std::filesystem::path pairs_folder(const PeerConfig& config, Side side);

// What the wearer wants, on the wearer's PC: as configured, else consent.json in the state folder.
[[nodiscard]] std::filesystem::path consent_file(const ConsentConfig& config);

// This side's own stop, which outlives restarts: as configured, else stop-active.json or stop-passive.json in the state
// folder.
[[nodiscard]] std::filesystem::path stop_file(const ControlConfig& config, Side side);

// A relative path that does not exist from here, such as "duemilanove-16.toml", is looked for among the installed
// jacket profiles.
[[nodiscard]] std::filesystem::path installed_jacket_file(const std::filesystem::path& given);

// The jacket profile: as configured, else the installed one of the 16-motor jacket.
[[nodiscard]] std::filesystem::path jacket_profile_file(const JacketConfig& config);

}  // namespace telehug
