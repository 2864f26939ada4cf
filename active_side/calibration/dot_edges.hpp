// SPDX-License-Identifier: Apache-2.0
//
// The last step of finding a calibration dot: its visible edge to parts of a pixel.
//
// Along the outline's normals the place where the picture falls from white to black most steeply is compared with the
// same place in a drawing of the dot, blurred like the picture: a thin ellipse's pointed ends look shorter when they
// are blurred, its flat sides do not. Least squares then give how far the dot is from where it was drawn, together with
// how much wider than drawn its edge is all around, for overexposed white spreads over black. Both ends tell that
// apart from a shift; without it the arc that the finger leaves visible would draw the centre its way.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "calibration/calibration_dot.hpp"

namespace telehug {

std::optional<CalibrationDot> fit_dot_edges(const cv::Mat& bgr, const RigCamera& camera, const ImagePoint& near,
                                            double diameter_mm);

}  // namespace telehug
