// SPDX-License-Identifier: Apache-2.0
#include "eval/rig_calibration.hpp"

#include <fmt/format.h>

#include <array>
#include <opencv2/core/mat.hpp>
#include <stdexcept>

#include "calibration/screen_border.hpp"
#include "eval/calibration_touches.hpp"
#include "eval/default_calibration.hpp"
#include "finger/thesis_detector.hpp"
#include "pictures/picture_file.hpp"
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

Result<BorderLine> find_border(const RigDirectory& rig, const std::filesystem::path& first_touch) {
  const auto source = rig.triangle ? *rig.triangle : rig.background.value_or(first_touch);
  const auto picture = read_picture(source);
  if (!picture) return picture.error();
  const auto border = find_screen_border(*picture, rig.triangle ? BorderChoice::triangle : BorderChoice::longest);
  if (!border) return Error{fmt::format("{}: {}", source.string(), border.error().message)};
  return border->line;
}

Result<Calibration> calibrate_thesis_from_recording(const RigDirectory& rig, const std::vector<int>& frames,
                                                    const std::string& date) {
  const std::vector<int> numbers = frames.empty() ? std::vector{1, 2} : frames;
  if (numbers.size() != 2) {
    return Error{
        fmt::format("the thesis' model is calibrated with 2 touches, not {}: name two, such as 1,2", numbers.size())};
  }
  const auto touched = calibration_touches(rig, numbers);
  if (!touched) return touched.error();
  const std::vector<const CalibrationTouch*>& known = *touched;
  const auto border = find_border(rig, known[0]->frame.picture);
  if (!border) return border.error();

  ImageSize image{};
  std::array<MeasuredTouch, 2> touches{};
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const auto picture = read_picture(known[i]->frame.picture);
    if (!picture) return picture.error();
    if (i == 0) image = {picture->cols, picture->rows};
    const auto unfit = [&](const std::string& why) {
      return Error{fmt::format("{}: {}", known[i]->frame.picture.string(), why)};
    };
    if (picture->cols != image.width_px || picture->rows != image.height_px) {
      return unfit(fmt::format("{}x{} pixels, but the first calibration picture has {}x{}", picture->cols,
                               picture->rows, image.width_px, image.height_px));
    }
    try {
      ThesisDetector detector(*border, image);
      const Fingers& fingers = detector.detect(*picture);
      if (fingers.empty()) return unfit("no finger crosses the screen's bottom border here: take this touch again");
      touches[i] = {known[i]->screen, fingers.front().length_px,
                    column_from_centre_px(fingers.front().tip.u_px, image)};
    } catch (const std::invalid_argument& error) {
      return unfit(error.what());
    }
  }
  const auto model = ThesisTouchModel::solve(rig.screen, touches[0], touches[1]);
  if (!model) return Error{fmt::format("{}: {}", rig.path.string(), model.error().message)};
  return Calibration{"recording " + rig.path.string(),  date, image, rig.screen, *border,
                     ThesisCalibration{touches, *model}};
}

}  // namespace

Result<Calibration> calibrate_from_recording(const RigDirectory& rig, const std::string& model,
                                             const std::vector<int>& frames, const std::string& date) {
  return model == "thesis" ? calibrate_thesis_from_recording(rig, frames, date)
                           : calibrate_default_from_recording(rig, frames, date);
}

}  // namespace telehug
