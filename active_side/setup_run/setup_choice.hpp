// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

enum class SetupMode {
  full,    // nine dots
  quick,   // two
  thesis,  // two, for the thesis' model
};

// What a person chooses before the screen is looked at.
struct SetupChoice {
  std::string camera;  // as make_frame_source() takes it
  ScreenSize screen;
  std::string monitor;  // RandR's name; empty: not known
  SetupMode mode = SetupMode::full;
  bool tuned = false;  // the camera's settings were searched for
};

[[nodiscard]] const char* name_of(SetupMode mode) noexcept;

// Reads "width_mm", "height_mm" (of the visible screen: 100 to 3000 mm), "width_px", "height_px" (0 if not known),
// "monitor" and "mode" of a request into `choice`; what is not there stays. The error is a sentence for the page, and
// then nothing has changed.
Status read_choice(const nlohmann::json& request, SetupChoice& choice);

}  // namespace telehug
