// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "calibration/calibration_policy.hpp"
#include "capture/rig_directory.hpp"
#include "capture/virtual_rig/export_rig.hpp"
#include "commands/calibrate_by_hand.hpp"
#include "commands/config_options.hpp"
#include "commands/utc_now.hpp"
#include "config/locator.hpp"
#include "config/places.hpp"
#include "eval/empty_rig.hpp"
#include "eval/rig_calibration.hpp"
#include "eval/temporary_directory.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigOptions config;
  std::string source;
  std::string out;
  std::string model;  // empty: as configured
  std::vector<int> frames;
  double width_mm = 0;
  double height_mm = 0;
  std::vector<std::string> points;
  bool two_dots = false;
};

Result<CalibratedRig> from_recording(const std::filesystem::path& folder, const std::string& model,
                                     const std::vector<int>& frames) {
  const auto rig = open_rig_directory(folder);
  if (!rig) return rig.error();
  auto calibration = calibrate_from_recording(*rig, model, frames, utc_now());
  if (!calibration) return calibration.error();
  auto empty = picture_of_empty_rig(*rig);
  if (!empty) {
    fmt::print("{}\n", empty.error().message);
    return CalibratedRig{*std::move(calibration), std::nullopt};
  }
  return CalibratedRig{*std::move(calibration), *std::move(empty)};
}

Result<CalibratedRig> from_virtual_rig(const std::string& source, const VirtualRigSettings& usual,
                                       const std::string& model, const std::vector<int>& frames) {
  const TemporaryDirectory scratch;
  // The default model's: with those far to the left and right. Rendering more takes its time and gains little.
  const int all = model == "thesis" ? 2 : 6;
  const int touches = frames.empty() ? all : *std::max_element(frames.begin(), frames.end());
  const ExportSettings calibration_only{
      .calibration_touches = touches, .sequence_frames = 0, .single_frames = 0, .hard_frames = 0};
  const auto spec = virtual_rig_spec(source);
  const Status exported = spec && spec->seed
                              ? export_rig_directory(random_rig(*spec->seed), scratch.path(), calibration_only)
                              : export_rig_directory(usual, scratch.path(), calibration_only);
  if (!exported) return exported.error();
  auto calibrated = from_recording(scratch.path(), model, frames);
  if (calibrated) calibrated->calibration.camera = source;
  return calibrated;
}

Result<CalibratedRig> calibrate(const Options& options, const ActiveConfig& config) {
  const std::string model = options.model.empty() ? config.touch.model : options.model;
  const std::string spec = options.source.empty() ? config.camera.source : options.source;
  const auto source = parse_camera_source(spec);
  if (!source) return source.error();
  const CaptureSettings capture = capture_settings(config);
  switch (source->kind) {
    case CameraSourceKind::recording:
      return from_recording(source->folder.substr(0, source->folder.find('?')), model, options.frames);
    case CameraSourceKind::virtual_rig:
      return from_virtual_rig(spec, capture.virtual_rig, model, options.frames);
    case CameraSourceKind::webcam:
      break;
  }
  HandCalibration by_hand;
  by_hand.model = model;
  by_hand.screen = config.rig.screen;
  by_hand.two_dots = options.two_dots;
  if (options.width_mm > 0) by_hand.screen.width_mm = options.width_mm;
  if (options.height_mm > 0) by_hand.screen.height_mm = options.height_mm;
  if (auto points = parse_points(options.points); points) {
    by_hand.points = *std::move(points);
  } else {
    return points.error();
  }
  const SteadyClock clock;
  auto camera = make_frame_source(spec, capture, clock);
  if (!camera) return camera.error();
  return calibrate_by_hand(**camera, by_hand, utc_now(), clock, std::cout);
}

double largest_error_mm(const RigCalibration& rig) {
  const RigSolution& solution = rig.solution;
  double largest = 0;
  for (std::size_t i = 0; i < solution.touches.size(); ++i) {
    const ScreenPoint& error = solution.touches[i].error_mm;
    if (solution.bad_touch != i && !rig.observations.touches[i].left_out)
      largest = std::max(largest, std::hypot(error.x_mm, error.y_mm));
  }
  return largest;
}

void print_touches(const RigCalibration& rig) {
  for (std::size_t i = 0; i < rig.observations.touches.size(); ++i) {
    const PointObservation& touch = rig.observations.touches[i];
    const ScreenPoint& error = rig.solution.touches[i].error_mm;
    fmt::print("touch {} at {:.0f},{:.0f} mm: {} {:+.2f} mm to the right, {:+.2f} mm down{}\n", i + 1,
               touch.screen.x_mm, touch.screen.y_mm, name_of(touch.evidence), error.x_mm, error.y_mm,
               rig.solution.bad_touch == i || touch.left_out ? ", not used" : "");
  }
}

// Prints what could be better. The error says why the calibration is not worth keeping.
Status judge(const Calibration& calibration) {
  const auto* rig = std::get_if<RigCalibration>(&calibration.solved);
  if (rig == nullptr) return Done{};
  print_touches(*rig);
  const CalibrationVerdict verdict = judge_calibration(*rig);
  for (const std::string& advice : verdict.advice)
    fmt::print("{}\n", advice);
  fmt::print("picture: {}; {} touches agree within {:.1f} mm\n", rig->solution.model.camera.orientation().name(),
             rig->observations.touches.size(), largest_error_mm(*rig));
  if (verdict.good()) return Done{};
  return Error{fmt::format("the calibration is not saved: {}", fmt::join(verdict.faults, "; "))};
}

ExitCode run(const Options& options) {
  const auto config = load_config(options.config);
  if (!config) return fail(ExitCode::config, config.error());
  const auto calibrated = calibrate(options, *config);
  if (!calibrated) return fail(ExitCode::device, calibrated.error());
  const Calibration* const calibration = &calibrated->calibration;
  if (const Status worth = judge(*calibration); !worth) return fail(ExitCode::device, worth.error());
  const std::filesystem::path out = options.out.empty() ? rig_file(config->rig) : std::filesystem::path(options.out);
  if (!calibrated->empty)
    fmt::print("there is no picture without a hand: `run` learns the background from its first pictures\n");
  if (const Status written = save_calibrated_rig(out, *calibrated); !written)
    return fail(ExitCode::device, written.error());
  fmt::print("calibrated: {}, screen {:.0f} x {:.0f} mm, camera {:.0f} mm {} the screen's top\nwritten to {}\n",
             calibration->camera, calibration->screen.width_mm, calibration->screen.height_mm,
             std::abs(calibration->camera_below_top_mm()), calibration->camera_below_top_mm() < 0 ? "above" : "below",
             out.string());
  return ExitCode::ok;
}

}  // namespace

void add_calibrate(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("calibrate", "Learn where the camera stands, from touches of known points");
  add_config_options(*command, options->config);
  command->add_option("--source", options->source,
                      "webcam (leads through the touches), replay:DIR, virtual or virtual:SEED");
  command->add_option("--out", options->out, "The calibration file; else where `run` looks for it");
  command->add_option("--frames", options->frames, "replay: and virtual: which calibration pictures, e.g. 1,2")
      ->delimiter(',');
  command
      ->add_option("--model", options->model,
                   "Which model places fingers on the screen; else the configured one. thesis uses two touches")
      ->check(CLI::IsMember({"thesis", "default"}));
  command->add_option("--width-mm", options->width_mm, "webcam: width of the visible screen");
  command->add_option("--height-mm", options->height_mm, "webcam: height of the visible screen");
  command->add_option("--point", options->points, "webcam: a point to touch, in mm from the screen's top left: X,Y")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--two-dots", options->two_dots, "webcam: touch two dots instead of nine");
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
