// SPDX-License-Identifier: Apache-2.0
#include "setup_run/tuning_with_finger.hpp"

#include "calibration/calibration_file.hpp"
#include "calibration/screen_border.hpp"
#include "capture/camera_memory.hpp"
#include "capture/finger_separation.hpp"
#include "capture/measure_scene.hpp"

namespace telehug {
namespace {

constexpr Duration longest_wait = 500ms;
constexpr int most_tries = 40;

Result<BorderPlace> border_in(const cv::Mat& picture, const std::filesystem::path& calibration_file) {
  const auto calibration = read_calibration(calibration_file);
  if (calibration && calibration->image.width_px == picture.cols && calibration->image.height_px == picture.rows) {
    return BorderPlace{calibration->border.v0_px, calibration->border.slope};
  }
  const auto found = find_screen_border(picture, BorderChoice::longest);
  if (!found) return found.error();
  return BorderPlace{found->line.v0_px, found->line.slope};
}

}  // namespace

Result<cv::Mat> fresh_picture(FrameSource& camera, const std::function<void(const cv::Mat&)>& seen,
                              const std::function<bool()>& goes_on) {
  Frame frame;
  int fresh = 0;
  for (int tries = 0; tries < most_tries; ++tries) {
    if (goes_on && !goes_on()) return Error{"it was broken off"};
    if (camera.read(frame, longest_wait) != ReadOutcome::frame) continue;
    if (seen) seen(frame.bgr);
    if (++fresh > settle_frames) return frame.bgr;
  }
  return Error{"no picture comes from the camera: " + camera.last_error()};
}

Result<Tuning> tune_with_finger(FrameSource& camera, const cv::Mat& empty, const cv::Mat& with,
                                const TunedWebcam& webcam, const TuningOptions& options, V4l2Calls& calls,
                                const Clock& clock, const std::function<void(const cv::Mat&)>& seen) {
  const auto border = border_in(empty, webcam.calibration_file);
  if (!border) return border.error();
  const auto separation = FingerSeparation::find(empty, with, *border);
  if (!separation) return separation.error();

  CameraControls controls(calls);
  if (const Status opened = controls.open(webcam.device); !opened) return opened.error();
  const auto tunable = tunable_controls(controls.list(), webcam.fps);
  if (tunable.empty())
    return Error{webcam.device + " has no setting that could be tuned; set camera.preset to \"keep\""};
  Frame frame;
  auto tuned = tune_camera(
      tunable, [&](const ControlValue& value) { return controls.set(value); },
      [&] {
        const auto score = measure_scene(camera, *separation, frame);
        if (score && seen) seen(frame.bgr);
        return score;
      },
      options, clock);
  if (!tuned || tuned->ended) return tuned;
  if (const Status kept = write_camera_memory(webcam.tuned_file, {webcam.device, tuned->values}); !kept)
    return kept.error();
  return tuned;
}

}  // namespace telehug
