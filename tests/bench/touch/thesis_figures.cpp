// SPDX-License-Identifier: Apache-2.0
#include "bench/touch/thesis_figures.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "bench/touch/touch_path.hpp"
#include "capture/frame_check.hpp"
#include "capture/rig_directory.hpp"
#include "eval/rig_calibration.hpp"
#include "finger/aligned_patch.hpp"
#include "finger/thesis_detector.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

struct Recording {
  BorderLine border;
  TouchedRig rig;
};

Recording load(const std::filesystem::path& folder) {
  const auto rig = open_rig_directory(folder);
  if (!rig) throw std::runtime_error(rig.error().message);
  const auto calibration = calibrate_from_recording(*rig, "thesis", {}, "");
  if (!calibration) throw std::runtime_error(calibration.error().message);
  Recording recording{calibration->border, {calibration->image, calibration->screen, calibration->model(), {}}};
  const RigPart* const part = rig->part("sequence");
  if (part == nullptr) throw std::runtime_error(folder.string() + " has no sequence");
  for (const RigFrame& frame : part->frames) {
    auto picture = read_picture(frame.picture);
    if (!picture) throw std::runtime_error(picture.error().message);
    recording.rig.pictures.push_back(*std::move(picture));
  }
  return recording;
}

// Whether a picture can be believed, before anything is looked for in it.
Figure measure_frame_check(const Recording& recording) {
  FrameCheck check(recording.rig.image, {recording.border.v0_px, recording.border.slope});
  Figure figure{"touch.frame_check_1280x720", "ms"};
  std::size_t believed = 0;
  for (int i = 0; i < bench_warm_up_rounds + bench_rounds; ++i) {
    const cv::Mat& picture = recording.rig.pictures[static_cast<std::size_t>(i) % recording.rig.pictures.size()];
    Stopwatch watch;
    believed += check.check(picture).verdict == FrameVerdict::good ? 1U : 0U;
    const double ms = watch.lap_ms();
    if (i >= bench_warm_up_rounds) figure.samples.push_back(ms);
  }
  if (believed == 0) throw std::runtime_error("no picture of the recording is believed");
  return figure;
}

// The part of `detect` that cuts and filters: along the whole border, and the finger down to the picture's bottom.
Figure measure_preprocessing(const Recording& recording) {
  const TouchedRig& rig = recording.rig;
  constexpr int margin_px = AlignedPatch::margin_px;
  const ThesisOptions options;
  const int columns = rig.image.width_px + 2 * margin_px;
  const int rows = rig.image.height_px + options.border_offset_px + 4 * margin_px;
  AlignedPatch patch({columns, rows});
  ThesisDetector detector(recording.border, rig.image, options);
  Figure figure{"touch.thesis.preprocess_1280x720", "ms"};
  figure.samples.reserve(bench_rounds);
  for (int i = 0; i < bench_warm_up_rounds + bench_rounds; ++i) {
    const cv::Mat& picture = rig.pictures[static_cast<std::size_t>(i) % rig.pictures.size()];
    const Fingers& fingers = detector.detect(picture);
    const int first_row = -options.border_offset_px - 1 - margin_px;
    Stopwatch watch;
    patch.cut(picture, recording.border, first_row, 3 + 2 * margin_px, -margin_px, columns);
    patch.erode_dilate_smooth();
    if (!fingers.empty()) {
      const int first = static_cast<int>(std::lround(fingers[0].left_px + 0.5));
      const int width = static_cast<int>(fingers[0].right_px - fingers[0].left_px);
      const int last_row = rig.image.height_px - static_cast<int>(recording.border.v_at(first));
      patch.cut(picture, recording.border, first_row, last_row - first_row + margin_px, first - margin_px,
                width + 2 * margin_px);
      patch.erode_dilate_smooth();
    }
    const double ms = watch.lap_ms();
    if (i >= bench_warm_up_rounds) figure.samples.push_back(ms);
  }
  return figure;
}

}  // namespace

Figures measure_thesis(const std::filesystem::path& folder) {
  const Recording recording = load(folder);
  Figures all;
  for (const bool continuity : {true, false}) {
    ThesisDetector detector(recording.border, recording.rig.image, {.continuity = continuity});
    for (Figure& figure :
         measure_path(detector, recording.rig, "thesis.", continuity ? "_1280x720" : "_1280x720.without_continuity"))
      all.push_back(std::move(figure));
  }
  all.push_back(measure_preprocessing(recording));
  all.push_back(measure_frame_check(recording));
  return all;
}

}  // namespace telehug
