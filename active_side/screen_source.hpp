// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/result.hpp"
#include "config/config.hpp"
#include "screen/screen_grabber.hpp"

namespace telehug {

// The grabber that [body_map] asks for, closed. "auto" is the configured picture if there is one; else the portal in a
// Wayland session and X11 elsewhere. The error says what is wrong with the configuration. `clock` outlives the grabber.
[[nodiscard]] Result<std::unique_ptr<ScreenGrabber>> make_screen_grabber(const ActiveConfig& config,
                                                                         const Clock& clock);

}  // namespace telehug
