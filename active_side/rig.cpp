// SPDX-License-Identifier: Apache-2.0
#include "rig.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "calibration/calibration_file.hpp"
#include "calibration/rig_accuracy.hpp"
#include "config/places.hpp"
#include "detection/make_detector.hpp"
#include "face/make_face_finder.hpp"
#include "screen_source.hpp"

namespace telehug {
namespace {

bool differs(double configured_mm, double calibrated_mm) {
  return configured_mm > 0 && std::abs(configured_mm - calibrated_mm) > 1;
}

std::shared_ptr<const std::vector<ScreenPoint>> reach_of(const Calibration& calibration) {
  const TouchModel touch = calibration.model();
  const auto* model = std::get_if<RigModel>(&touch);
  if (model == nullptr) return nullptr;
  return std::make_shared<const std::vector<ScreenPoint>>(reach(*model, calibration.screen).outline);
}

}  // namespace

Result<std::unique_ptr<Rig>> make_rig(const ActiveConfig& config, TouchStream& stream, const Clock& clock,
                                      MetricsRegistry& metrics, std::uint32_t versions_after) {
  const std::filesystem::path path = rig_file(config.rig);
  if (!std::filesystem::exists(path)) {
    return Error{
        fmt::format("there is no calibration yet ({}); make one with `telehug-active calibrate`", path.string())};
  }
  auto calibration = read_calibration(path);
  if (!calibration) return calibration.error();
  const ScreenSize& screen = calibration->screen;
  if (differs(config.rig.screen.width_mm, screen.width_mm) || differs(config.rig.screen.height_mm, screen.height_mm)) {
    return Error{fmt::format(
        "{} was made for a screen of {:.0f} x {:.0f} mm, but [rig] of the configuration says "
        "{:.0f} x {:.0f} mm; calibrate again or correct the configuration",
        path.string(), screen.width_mm, screen.height_mm, config.rig.screen.width_mm, config.rig.screen.height_mm)};
  }
  if (config.touch.model == "thesis" && !std::holds_alternative<ThesisCalibration>(calibration->solved)) {
    return Error{
        fmt::format("{} holds the default model, but [touch] of the configuration wants the thesis': "
                    "calibrate again or correct the configuration",
                    path.string())};
  }
  auto faces = make_face_finder(config.body_map.face);
  if (!faces) return faces.error();

  ActivePipelineOptions options;
  const bool real_camera = config.camera.source.starts_with("webcam");
  if (!real_camera) options.frames.frozen_after = 0;
  options.max_map_age = std::chrono::milliseconds(config.body_map.max_age_ms);
  BodyMapStepConfig step = body_map_step_config(config.body_map, screen);
  step.tracker.versions_after = versions_after;
  auto grabber = make_screen_grabber(config, clock);
  if (!grabber) return grabber.error();
  auto face = std::make_shared<FaceWorker>(*std::move(grabber), std::move(faces->finder), step, config.body_map.rate_hz,
                                           clock, metrics);
  try {
    std::optional<BorderStrip> background;
    std::string note = faces->note;
    const std::string ignored = ignored_screen_keys(config.body_map);
    if (!ignored.empty()) note += (note.empty() ? "" : " ") + ignored;
    const std::string face_note = note;
    if (config.touch.detector != "thesis") {
      auto kept = read_background_of(path, *calibration);
      if (kept) {
        background = *std::move(kept);
      } else {
        note += fmt::format("{}{}: the background is learnt from the first pictures in which nothing moves",
                            note.empty() ? "" : " ", kept.error().message);
      }
    }
    AnyDetector detector = make_detector(config.touch.detector, *calibration, background);
    options.tracker = tracker_options(*calibration, detector);
    options.tracker.up_after = std::chrono::milliseconds(config.touch.up_after_ms);
    return std::make_unique<Rig>(Rig{ActivePipeline(*calibration, std::move(detector), options, stream, clock, metrics),
                                     std::move(face), config.touch.detector, calibration->model_name(),
                                     calibration->date, reach_of(*calibration), face_note, note});
  } catch (const std::invalid_argument& problem) {
    return Error{fmt::format("{}: {}; calibrate again", path.string(), problem.what())};
  }
}

}  // namespace telehug
