// SPDX-License-Identifier: Apache-2.0
#include "eval/default_calibration.hpp"

#include <fmt/format.h>

#include <opencv2/core/mat.hpp>
#include <utility>

#include "detection/touch_calibration.hpp"
#include "eval/calibration_touches.hpp"
#include "eval/empty_rig.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

Result<cv::Mat> read_same_size(const std::filesystem::path& path, const cv::Mat& first) {
  auto picture = read_picture(path);
  if (!picture || first.empty() || picture->size() == first.size()) return picture;
  return Error{fmt::format("{}: {}x{} pixels, but the first calibration picture has {}x{}", path.string(),
                           picture->cols, picture->rows, first.cols, first.rows)};
}

}  // namespace

Result<Calibration> calibrate_default_from_recording(const RigDirectory& rig, const std::vector<int>& frames,
                                                     const std::string& date) {
  std::vector<const CalibrationTouch*> wanted;
  if (frames.empty()) {
    for (const CalibrationTouch& touch : rig.calibration)
      wanted.push_back(&touch);
  } else if (auto named = calibration_touches(rig, frames); named) {
    wanted = *std::move(named);
  } else {
    return named.error();
  }
  if (wanted.empty()) return Error{fmt::format("{} has no calibration touches", rig.path.string())};

  CalibrationPictures pictures;
  pictures.screen = rig.screen;
  for (const CalibrationTouch* touch : wanted) {
    const cv::Mat first = pictures.touches.empty() ? cv::Mat() : pictures.touches.front().bgr;
    auto picture = read_same_size(touch->frame.picture, first);
    if (!picture) return picture.error();
    pictures.touches.push_back({*std::move(picture), touch->screen});
  }
  const cv::Mat& first = pictures.touches.front().bgr;
  // Two touches and nothing else are no picture with nobody there, but the screen's edge is seen beside the hand.
  auto empty = picture_of_empty_rig(rig);
  pictures.empty = empty ? *std::move(empty) : first;
  if (pictures.empty.size() != first.size()) {
    return Error{fmt::format("{}: the picture with nobody there has {}x{} pixels, but the calibration has {}x{}",
                             rig.path.string(), pictures.empty.cols, pictures.empty.rows, first.cols, first.rows)};
  }
  if (rig.triangle) {
    auto triangle = read_same_size(*rig.triangle, first);
    if (!triangle) return triangle.error();
    pictures.triangle = *std::move(triangle);
  }
  if (rig.marks) {
    auto marks = read_same_size(*rig.marks, first);
    if (!marks) return marks.error();
    pictures.marks = *std::move(marks);
  }
  auto solved = calibrate_with_pictures(pictures);
  if (!solved) return Error{fmt::format("{}: {}", rig.path.string(), solved.error().message)};
  const RigCamera& camera = solved->solution.model.camera;
  return Calibration{"recording " + rig.path.string(), date,
                     {first.cols, first.rows},         rig.screen,
                     border_line(camera, rig.screen),  *std::move(solved)};
}

}  // namespace telehug
