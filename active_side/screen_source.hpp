// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "body_map/body_map_step.hpp"
#include "common/result.hpp"
#include "config/config.hpp"
#include "screen/screen_grabber.hpp"

namespace telehug {

// The grabber that [body_map] asks for, closed. "auto" is the configured picture if there is one; else the portal in a
// Wayland session and X11 elsewhere. The error says what is wrong with the configuration. `clock` outlives the grabber.
[[nodiscard]] Result<std::unique_ptr<ScreenGrabber>> make_screen_grabber(const ActiveConfig& config,
                                                                         const Clock& clock);

// One sentence if keys are set that the source can't honour: only X11 knows windows and the names of monitors. Else
// empty.
[[nodiscard]] std::string ignored_screen_keys(const BodyMapConfig& config);

// How the pictures are looked at. `screen`: none if nobody has measured it.
[[nodiscard]] BodyMapStepConfig body_map_step_config(const BodyMapConfig& config,
                                                     const std::optional<ScreenSize>& screen);

}  // namespace telehug
