// SPDX-License-Identifier: Apache-2.0
//
// The values of the configuration that name a thing and, after a colon, where it is; a rectangle; and addresses.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace telehug {

enum class CameraSourceKind { webcam, recording, virtual_rig };

struct CameraSource {
  CameraSourceKind kind = CameraSourceKind::webcam;
  std::string folder;  // of a recording
};

// "webcam", "replay:DIR", "virtual" or "virtual:SEED" (up to 9 digits), both also with "?DIR".
[[nodiscard]] Result<CameraSource> parse_camera_source(std::string_view text);

enum class ScreenSourceKind { automatic, x11, portal, picture, camera, recording };

struct ScreenSource {
  ScreenSourceKind kind = ScreenSourceKind::automatic;
  std::string place;  // device of a camera, folder of a recording
};

// "auto", "x11", "portal", "picture", "camera:DEVICE" or "replay:DIR".
[[nodiscard]] Result<ScreenSource> parse_screen_source(std::string_view text);

// Pixels of the monitor.
struct ScreenRegion {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;  // above 0
  int height_px = 0;
};

// "X,Y,WIDTH,HEIGHT" in px; empty: none.
[[nodiscard]] Result<std::optional<ScreenRegion>> parse_screen_region(std::string_view text);

// Ids of pairs with commas between them; empty: none are named. "all" is one of them.
[[nodiscard]] Result<std::vector<std::string>> parse_pairs(std::string_view text);

// IPv4 addresses with commas between them, each with ":PORT" behind it if wanted; empty: none.
[[nodiscard]] Result<std::vector<std::string>> parse_addresses(std::string_view text);

// One IPv4 address, or empty.
[[nodiscard]] Result<std::string> parse_address(std::string_view text);

enum class JacketLinkKind { serial, bluetooth, simulated, recorded };

struct JacketLinkChoice {
  JacketLinkKind kind = JacketLinkKind::simulated;
  std::string path;  // of the serial device (or "auto"), of Bluetooth, or of the file that is recorded to
};

// "serial:PATH", "serial:auto", "rfcomm:ADDRESS", "rfcomm:ADDRESS/CHANNEL", "simulated" or "record:FILE".
[[nodiscard]] Result<JacketLinkChoice> parse_jacket_link(std::string_view text);

// Likewise; an empty text is none.
[[nodiscard]] Result<std::optional<JacketLinkChoice>> parse_optional_jacket_link(std::string_view text);

}  // namespace telehug
