// SPDX-License-Identifier: Apache-2.0
//
// A set-up's state for the page's JavaScript. These names stay as they are; null where there is nothing.
//
//   step          "bright", "confirm_border", "background", "marks", "dots", "solving", "solved", "saved", "cancelled"
//   show          what the whole screen shows, in mm from its top left:
//     page        "none", "triangle" (black on white), "black", "marks" or "dot" (white on black)
//     width_mm, height_mm    of the screen
//     triangle    [[x_mm, y_mm] x 3], for "triangle", else []
//     dots        [[x_mm, y_mm], ...], for "marks" and "dot", else []
//     dot_mm      their diameter
//   advice        a code of SetupAdvice: "touch_dot", "finger_moves", ...
//   progress      0 to 1
//   image         {width_px, height_px} of the camera's pictures, for all that is in px
//   green_band    {top_px, bottom_px} or null
//   border        {points: [[u_px, v_px], ...], vertex: [u_px, v_px] or null, roll_deg, in_band} or null
//   camera_known  true: the marks have told where the camera is
//   dots          [[x_mm, y_mm], ...] all that are to be touched
//   dot           index of the one that is shown, from 0
//   taken         counts up with each dot that is accepted
//   finger        [u_px, v_px] or null
//   off_mm        [x, y] from the dot to the finger, or null
//   can           {confirm, back, skip, save}: true if that can be done now
//   result        null until solved; then
//     good        true: it can be saved
//     dots        [{x_mm, y_mm, used, skipped, error_mm: [x, y] or null}, ...]
//     repeat      [index, ...] of dots to take again
//     faults, remarks   [sentence, ...] in English
//     reach       [[x_mm, y_mm], ...] outline of what the camera sees of the screen
//     errors      {columns, rows, horizontal_mm: [...], vertical_mm: [...]}: standard deviations, row by row from the
//                 screen's top left, null where the camera sees nothing
#pragma once

#include <nlohmann/json.hpp>

#include "setup/setup_state.hpp"

namespace telehug {

[[nodiscard]] nlohmann::json setup_json(const SetupState& state, const ScreenSize& screen);

}  // namespace telehug
