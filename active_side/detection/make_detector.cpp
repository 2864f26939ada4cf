// SPDX-License-Identifier: Apache-2.0
#include "detection/make_detector.hpp"

#include <fmt/core.h>

#include <optional>
#include <utility>
#include <variant>

#include "finger/background_file.hpp"
#include "touch/camera_foot.hpp"

namespace telehug {

BorderStrip::Layout strip_layout(const Calibration& calibration) {
  return {border_curve(upright(calibration)), calibration.image};
}

Result<BorderStrip> read_background_of(const std::filesystem::path& calibration_file, const Calibration& calibration) {
  const std::filesystem::path path = background_file(calibration_file);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return Error{fmt::format("there is no {}", path.string())};
  return read_background(path, strip_layout(calibration));
}

AnyDetector make_detector(const std::string& choice, const Calibration& calibration,
                          const std::optional<BorderStrip>& background) {
  const Calibration turned = upright(calibration);
  if (choice == "thesis") return ThesisDetector(turned.border, turned.image);
  const auto* const rig = std::get_if<RigCalibration>(&turned.solved);
  return FingerDetector(border_curve(turned), turned.image, background,
                        rig == nullptr ? std::nullopt : std::optional(rig->solution.model.camera));
}

TrackerOptions tracker_options(const Calibration& calibration, const AnyDetector& detector) {
  const auto* const rig = std::get_if<RigCalibration>(&calibration.solved);
  TrackerOptions options;
  options.every_finger_touches = rig == nullptr || !std::holds_alternative<FingerDetector>(detector);
  if (rig != nullptr) options.camera = camera_foot(rig->solution.model.camera, calibration.screen);
  return options;
}

}  // namespace telehug
