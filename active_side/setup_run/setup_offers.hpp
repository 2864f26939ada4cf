// SPDX-License-Identifier: Apache-2.0
//
// What a person can choose from: the cameras and monitors of this PC.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/config.hpp"
#include "screen_x11/x11_monitor_sizes.hpp"

namespace telehug {

struct OfferedCamera {
  std::string source;  // as make_frame_source() takes it
  std::string name;    // for people
};

// The configured one, then every other webcam that is plugged in.
[[nodiscard]] std::vector<OfferedCamera> offered_cameras(const CameraConfig& configured,
                                                         const std::filesystem::path& webcams = "/dev/v4l/by-id");

// Of the X server of $DISPLAY; none without one.
[[nodiscard]] std::vector<SizedMonitor> monitors_of_display();

// {"cameras": [{source, name}], "monitors": [{name, primary, x_px, y_px, width_px, height_px, width_mm, height_mm,
// size_from: "edid", "randr" or "nowhere"}]}
[[nodiscard]] nlohmann::json offers_json(const std::vector<OfferedCamera>& cameras,
                                         const std::vector<SizedMonitor>& monitors);

}  // namespace telehug
