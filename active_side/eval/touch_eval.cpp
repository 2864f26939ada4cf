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

constexpr Duration frame_interval = std::chrono::nanoseconds{1'000'000'000 / 30};

Status check_choice(const char* option, const std::string& choice) {
  if (choice == "thesis" || choice == "default") return Done{};
  return Error{fmt::format("--{} {} is unknown; there are: thesis, default", option, choice)};
}

// Reads the pictures of a part in order and collects what is found in each.
class Evaluation {
 public:
  Evaluation(EvalTouchReport& report, AnyDetector detector)
      : report_(report),
        detector_(std::move(detector)),
        model_(upright(report.calibration).model()),
        upright_(report.calibration.image, is_upside_down(report.calibration)),
        tracker_(tracker_options(report.calibration, detector_)) {}

  void run(const RigPart& part) {
    const bool is_recording = part.name == "sequence";
    for (std::size_t i = 0; i < part.frames.size(); ++i) {
      const FingerObservations fingers = fingers_in(part.frames[i]);
      FoundTouches found{part.frames[i].name, {}};
      if (is_recording) {
        const auto index = static_cast<Duration::rep>(i);
        const Timestamp time = part.times.empty() ? Timestamp{} + index * frame_interval : part.times[i];
        found.points = tracked(fingers, time);
      } else {
        found.points = touching(fingers);
      }
      report_.found.push_back(std::move(found));
    }
  }

 private:
  FingerObservations fingers_in(const RigFrame& frame) {
    const auto picture = read_picture(frame.picture);
    if (!picture) {
      report_.unreadable.push_back(picture.error().message);
      return {};
    }
    const ImageSize image = report_.calibration.image;
    if (picture->cols != image.width_px || picture->rows != image.height_px) {
      report_.unreadable.push_back(fmt::format("{}: {}x{} pixels, but the calibration has {}x{}",
                                               frame.picture.string(), picture->cols, picture->rows, image.width_px,
                                               image.height_px));
      return {};
    }
    const auto touched =
        screen_points(detect(detector_, upright_.of(*picture)), model_, report_.calibration.screen, image);
    report_.dropped += touched.dropped;
    return touched.fingers;
  }

  [[nodiscard]] std::vector<ScreenPoint> touching(const FingerObservations& fingers) const {
    std::vector<ScreenPoint> places;
    for (const FingerObservation& finger : fingers) {
      if (touches_alone(finger) && near_screen(finger.screen, report_.calibration.screen)) {
        places.push_back(finger.screen);
      }
    }
    return places;
  }

  std::vector<ScreenPoint> tracked(const FingerObservations& fingers, Timestamp time) {
    std::vector<ScreenPoint> places;
    for (const ContactState& state : tracker_.update(fingers, time)) {
      const bool more_likely_touches = state.phase != Phase::up && state.touching >= 0.5;
      if (more_likely_touches && near_screen(state.screen, report_.calibration.screen)) places.push_back(state.screen);
    }
    return places;
  }

  EvalTouchReport& report_;
  AnyDetector detector_;
  TouchModel model_;
  UprightPicture upright_;
  ContactTracker tracker_;
};

Result<AnyDetector> detector_for(const std::string& choice, const Calibration& calibration, const RigDirectory& rig) {
  try {
    if (choice == "thesis") return make_detector(choice, calibration, std::nullopt);
    const auto picture = picture_of_empty_rig(rig);
    if (!picture) return picture.error();
    const BorderStrip::Layout layout = strip_layout(calibration);
    if (picture->cols != layout.image.width_px || picture->rows != layout.image.height_px) {
      return Error{fmt::format("{}: the picture with nobody there has {}x{} pixels, but the calibration has {}x{}",
                               rig.path.string(), picture->cols, picture->rows, layout.image.width_px,
                               layout.image.height_px)};
    }
    BorderStrip empty(layout);
    empty.sample(UprightPicture(layout.image, is_upside_down(calibration)).of(*picture), layout);
    return make_detector(choice, calibration, empty);
  } catch (const std::invalid_argument& problem) {
    return Error{fmt::format("{}: {}", rig.path.string(), problem.what())};
  }
}

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
  if (auto known = check_choice("detector", options.detector); !known) return known.error();
  if (auto known = check_choice("model", options.model); !known) return known.error();
  const auto rig = open_rig_directory(options.rig);
  if (!rig) return rig.error();
  const RigPart* const part = rig->part(options.part);
  if (part == nullptr) {
    return Error{
        fmt::format("{} has no part \"{}\"; there can be: frames, hard, sequence", options.rig.string(), options.part)};
  }
  auto calibration = calibrate_from_recording(*rig, options.model, options.calibration, "");
  if (!calibration) return calibration.error();

  const std::string model = calibration->model_name();
  auto detector = detector_for(options.detector, *calibration, *rig);
  if (!detector) return detector.error();
  EvalTouchReport report{options, options.detector, model, std::move(*calibration), {}, {}, 0, std::nullopt};
  Evaluation(report, *std::move(detector)).run(*part);
  if (!part->truth.empty()) report.score = score_touches(report.found, part->truth);
  if (!options.out.empty()) {
    if (auto written = write_csv(options.out, report.found); !written) return written.error();
  }
  return report;
}

}  // namespace telehug
