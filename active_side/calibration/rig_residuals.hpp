// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "calibration/rig_model.hpp"
#include "calibration/rig_observations.hpp"

namespace telehug {

// The image residuals of one rig: where the model sees each observation, minus where the picture shows it, px. Nothing
// if the camera can't see it.
[[nodiscard]] std::optional<ImagePoint> touch_residual(const RigModel& model, const PointObservation& touch);
// Where on the screen the model places a touch.
[[nodiscard]] std::optional<ScreenPoint> touched_point(const RigModel& model, const PointObservation& touch);
[[nodiscard]] std::optional<ImagePoint> mark_residual(const RigModel& model, const PointObservation& mark);
// Of the row alone: the image of the screen's bottom edge in that column.
[[nodiscard]] std::optional<double> border_residual(const RigModel& model, double screen_height_mm,
                                                    const BorderObservation& border);

// The row in which the camera sees the screen's bottom edge (as a line without ends) in a column. Nothing if it sees
// none there.
[[nodiscard]] std::optional<double> border_row(const RigCamera& camera, double screen_height_mm, double u_px);

}  // namespace telehug
