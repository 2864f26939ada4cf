// SPDX-License-Identifier: Apache-2.0
//
// The two values of the configuration that name a thing and, after a colon, where it is.
#pragma once

#include <string>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

enum class CameraSourceKind { webcam, recording, virtual_rig };

struct CameraSource {
  CameraSourceKind kind = CameraSourceKind::webcam;
  std::string folder;  // of a recording
};

// "webcam", "replay:DIR", "virtual" or "virtual:SEED" (up to 9 digits).
[[nodiscard]] Result<CameraSource> parse_camera_source(std::string_view text);

enum class JacketLinkKind { serial, simulated, recorded };

struct JacketLinkChoice {
  JacketLinkKind kind = JacketLinkKind::simulated;
  std::string path;  // of the serial device, or of the file that is recorded to
};

// "serial:PATH", "simulated" or "record:FILE".
[[nodiscard]] Result<JacketLinkChoice> parse_jacket_link(std::string_view text);

}  // namespace telehug
