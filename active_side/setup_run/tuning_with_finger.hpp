// SPDX-License-Identifier: Apache-2.0
//
// A webcam's settings searched for while a finger rests on the screen: what `telehug-active camera tune` and the set-up
// page do once they have the two pictures.
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>

#include "capture/camera_tuning.hpp"
#include "capture/frame_source.hpp"
#include "capture/v4l2_calls.hpp"
#include "common/result.hpp"

namespace telehug {

struct TunedWebcam {
  std::string device;
  double fps = 30;
  std::filesystem::path calibration_file;  // of an earlier set-up, which knows the screen's edge; may be missing
  std::filesystem::path tuned_file;        // where the settings are kept
};

// A picture that was taken after this call began; `seen` is shown each that comes. `goes_on` is asked every half second
// at least; false: an error comes back at once.
[[nodiscard]] Result<cv::Mat> fresh_picture(FrameSource& camera,
                                            const std::function<void(const cv::Mat&)>& seen = nullptr,
                                            const std::function<bool()>& goes_on = nullptr);

// `empty` and `with`: pictures without and with the finger, which stays where it is. The camera is open, with its
// automatics off. What was found is kept in the file, unless it was ended.
// An error says what to do; also that the camera has no settings.
[[nodiscard]] Result<Tuning> tune_with_finger(FrameSource& camera, const cv::Mat& empty, const cv::Mat& with,
                                              const TunedWebcam& webcam, const TuningOptions& options, V4l2Calls& calls,
                                              const Clock& clock,
                                              const std::function<void(const cv::Mat&)>& seen = nullptr);

}  // namespace telehug
