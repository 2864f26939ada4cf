// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "capture/frame_source.hpp"

namespace telehug {

// A value of one picture, greater is better.
using Objective = std::function<double(const cv::Mat&)>;

// Pictures that may have been exposed before a setting took effect: those that wait in the camera's buffers, and one
// that is on its way.
inline constexpr int settle_frames = 5;

// The objective of what the camera sees from now on: the middle of a few pictures, after the settling ones. Nothing if
// none comes within 500 ms, as when the camera is unplugged. `frame` is room for pictures.
[[nodiscard]] std::optional<double> measure_scene(FrameSource& camera, const Objective& objective, Frame& frame);

}  // namespace telehug
