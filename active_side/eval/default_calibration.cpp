// SPDX-License-Identifier: Apache-2.0
#include "eval/default_calibration.hpp"

#include <fmt/format.h>

#include <opencv2/core/mat.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "calibration/border_choice.hpp"
#include "calibration/dot_touches.hpp"
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

Result<BorderPicture> look_at_border(const RigDirectory& rig, const std::filesystem::path& source,
                                     BorderChoice choice) {
  const auto picture = read_picture(source);
  if (!picture) return picture.error();
  const auto border = find_screen_border(*picture, choice);
  if (!border) return Error{fmt::format("{}: {}", source.string(), border.error().message)};
  return BorderPicture{border->line, find_border_candidates(*picture, border->line),
                       triangle_mark(*border, rig.screen)};
}

// A triangle whose vertex can't be seen is no reason to give up: the touches choose among the background's edges, too.
Result<BorderPicture> look_at_border(const RigDirectory& rig, const std::filesystem::path& otherwise) {
  if (rig.triangle) {
    auto border = look_at_border(rig, *rig.triangle, BorderChoice::triangle);
    if (border || !rig.background) return border;
  }
  return look_at_border(rig, rig.background.value_or(otherwise), BorderChoice::longest);
}

Result<std::vector<DotPicture>> read_pictures(const std::vector<const CalibrationTouch*>& touches) {
  std::vector<DotPicture> pictures;
  for (const CalibrationTouch* touch : touches) {
    const auto picture = read_picture(touch->frame.picture);
    if (!picture) return picture.error();
    const cv::Mat& first = pictures.empty() ? *picture : pictures.front().bgr;
    if (picture->size() != first.size()) {
      return Error{fmt::format("{}: {}x{} pixels, but the first calibration picture has {}x{}",
                               touch->frame.picture.string(), picture->cols, picture->rows, first.cols, first.rows)};
    }
    pictures.push_back({*picture, touch->screen, std::nullopt});
  }
  return pictures;
}

Result<std::vector<PointObservation>> fingertips(const std::vector<DotPicture>& pictures, const BorderLine& level) {
  std::vector<PointObservation> touches;
  try {
    ThesisDetector detector(level, {pictures.front().bgr.cols, pictures.front().bgr.rows});
    for (const DotPicture& picture : pictures) {
      const Fingers& fingers = detector.detect(picture.bgr);
      if (fingers.empty()) continue;
      touches.push_back({picture.screen, fingers.front().tip, thesis_tip_sigma_px, thesis_tip_sigma_px});
    }
  } catch (const std::invalid_argument& error) {
    return Error{error.what()};
  }
  return touches;
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

  auto pictures = read_pictures(wanted);
  if (!pictures) return pictures.error();
  RigObservations seen;
  seen.screen = rig.screen;
  seen.image = {pictures->front().bgr.cols, pictures->front().bgr.rows};
  if (border->mark) seen.marks.push_back(*border->mark);
  find_dots(*pictures, border->level);
  seen.touches = dot_touches(*pictures);
  const bool dots = !seen.touches.empty();
  if (!dots) {
    auto tips = fingertips(*pictures, border->level);
    if (!tips) return Error{fmt::format("{}: {}", rig.path.string(), tips.error().message)};
    seen.touches = *std::move(tips);
  }
  if (seen.touches.size() < 2) {
    return Error{fmt::format(
        "{}: a touched dot or a finger was found in {} of {} calibration pictures, and 2 are needed: take them again",
        rig.path.string(), seen.touches.size(), wanted.size())};
  }
  auto solved =
      dots ? solve_with_dots(seen, *pictures, border->candidates) : solve_with_border(seen, border->candidates);
  if (!solved) return Error{fmt::format("{}: {}", rig.path.string(), solved.error().message)};
  const RigCamera& camera = solved->calibration.solution.model.camera;
  return Calibration{"recording " + rig.path.string(), date, seen.image, rig.screen, border_line(camera, rig.screen),
                     std::move(solved->calibration)};
}

}  // namespace telehug
