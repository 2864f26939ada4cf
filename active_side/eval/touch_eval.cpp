// SPDX-License-Identifier: Apache-2.0
#include "eval/touch_eval.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <opencv2/core/mat.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "capture/rig_directory.hpp"
#include "common/clock.hpp"
#include "detection/make_detector.hpp"
#include "detection/upright_picture.hpp"
#include "eval/empty_rig.hpp"
#include "eval/rig_calibration.hpp"
#include "finger/any_detector.hpp"
#include "pictures/picture_file.hpp"
#include "touch/contact_tracker.hpp"
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

Status write_csv(const std::filesystem::path& path, const std::vector<FoundTouches>& found) {
  std::ofstream out(path);
  out << "frame,contact,x_mm,y_mm\n";
  for (const FoundTouches& frame : found) {
    if (frame.points.empty()) out << fmt::format("{},0,,\n", frame.frame);
    for (const ScreenPoint& point : frame.points) {
      out << fmt::format("{},1,{:.2f},{:.2f}\n", frame.frame, point.x_mm, point.y_mm);
    }
  }
  out.close();
  if (out) return Done{};
  return Error{fmt::format("can't write {}: {}", path.string(), std::generic_category().message(errno))};
}

}  // namespace

Result<EvalTouchReport> eval_touch(const EvalTouchOptions& options) {
  if (auto known = check_algorithm(options.algorithm); !known) return known.error();
  const auto recording = open_rig_directory(options.rig);
  if (!recording) return recording.error();
  const RigPart* const part = recording->part(options.part);
  if (part == nullptr) {
    return Error{
        fmt::format("{} has no part \"{}\"; there can be: frames, hard, sequence", options.rig.string(), options.part)};
  }
  auto rig = calibrate_rig(*recording, options.algorithm, options.calibration);
  if (!rig) return rig.error();
  EvalTouchReport report{options, rig->calibration, evaluate_part(*rig, *part), std::nullopt, {}};
  if (!part->truth.empty()) report.score = score_touches(report.part.found, part->truth);
  if (report.score && options.failure_pictures) {
    report.failures = biggest(picture_failures(failures_of(*report.score), rig->calibration, *part), failures_kept);
  }
  if (!options.out.empty()) {
    if (auto written = write_csv(options.out, report.part.found); !written) return written.error();
  }
  return report;
}

}  // namespace telehug
