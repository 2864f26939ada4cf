// SPDX-License-Identifier: Apache-2.0
#include "eval/default_calibration.hpp"

#include <fmt/format.h>

#include <opencv2/core/mat.hpp>
#include <stdexcept>

#include "calibration/border_choice.hpp"
#include "calibration/screen_border.hpp"
#include "eval/calibration_touches.hpp"
#include "finger/thesis_detector.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

struct BorderPicture {
  BorderLine level;
  std::vector<BorderCandidate> candidates;
  std::optional<PointObservation> mark;
};

Result<BorderPicture> look_at_border(const RigDirectory& rig, const std::filesystem::path& otherwise) {
  const auto source = rig.triangle ? *rig.triangle : rig.background.value_or(otherwise);
  const auto picture = read_picture(source);
  if (!picture) return picture.error();
  const auto border = find_screen_border(*picture, rig.triangle ? BorderChoice::triangle : BorderChoice::longest);
  if (!border) return Error{fmt::format("{}: {}", source.string(), border.error().message)};
  return BorderPicture{border->line, find_border_candidates(*picture, border->line),
                       triangle_mark(*border, rig.screen)};
}

Status add_touch(RigObservations& seen, const CalibrationTouch& touch, const BorderLine& level) {
  const auto picture = read_picture(touch.frame.picture);
  if (!picture) return picture.error();
  if (seen.image.width_px == 0) seen.image = {picture->cols, picture->rows};
  if (picture->cols != seen.image.width_px || picture->rows != seen.image.height_px) {
    return Error{fmt::format("{}: {}x{} pixels, but the first calibration picture has {}x{}",
                             touch.frame.picture.string(), picture->cols, picture->rows, seen.image.width_px,
                             seen.image.height_px)};
  }
  try {
    ThesisDetector detector(level, seen.image);
    const Fingers& fingers = detector.detect(*picture);
    if (!fingers.empty())
      seen.touches.push_back({touch.screen, fingers.front().tip, thesis_tip_sigma_px, thesis_tip_sigma_px});
    return Done{};
  } catch (const std::invalid_argument& error) {
    return Error{fmt::format("{}: {}", touch.frame.picture.string(), error.what())};
  }
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
  const auto border = look_at_border(rig, wanted.front()->frame.picture);
  if (!border) return border.error();

  RigObservations seen;
  seen.screen = rig.screen;
  for (const CalibrationTouch* touch : wanted) {
    if (const Status added = add_touch(seen, *touch, border->level); !added) return added.error();
  }
  if (border->mark) seen.marks.push_back(*border->mark);
  if (seen.touches.size() < 2) {
    return Error{
        fmt::format("{}: a finger was found in {} of {} calibration pictures, and 2 are needed: take them again",
                    rig.path.string(), seen.touches.size(), wanted.size())};
  }
  auto solved = solve_with_border(seen, border->candidates);
  if (!solved) return Error{fmt::format("{}: {}", rig.path.string(), solved.error().message)};
  const RigCamera& camera = solved->calibration.solution.model.camera;
  return Calibration{"recording " + rig.path.string(), date, seen.image, rig.screen, border_line(camera, rig.screen),
                     std::move(solved->calibration)};
}

}  // namespace telehug
