// SPDX-License-Identifier: Apache-2.0
#include "eval/rig_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/clock.hpp"
#include "detection/make_detector.hpp"
#include "detection/upright_picture.hpp"
#include "eval/empty_rig.hpp"
#include "eval/rig_calibration.hpp"
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
  explicit Evaluation(const EvaluatedRig& rig)
      : calibration_(rig.calibration),
        detector_(make_detector(rig.detector, calibration_, rig.empty)),
        model_(upright(calibration_).model()),
        upright_(calibration_.image, is_upside_down(calibration_)),
        tracker_(tracker_options(calibration_, detector_)) {}

  EvaluatedPart run(const RigPart& part) {
    const bool is_recording = part.name == "sequence";
    for (std::size_t i = 0; i < part.frames.size(); ++i) {
      const FingerObservations fingers = fingers_in(part.frames[i]);
      FoundTouches found{part.frames[i].name, {}};
      if (is_recording) {
        const auto index = static_cast<Duration::rep>(i);
        const Timestamp time = part.times.empty() ? Timestamp{} + index * frame_interval : part.times[i];
        found.points = tracked(fingers, time, part.frames[i].name);
      } else {
        found.points = touching(fingers);
      }
      evaluated_.found.push_back(std::move(found));
    }
    return std::move(evaluated_);
  }

 private:
  FingerObservations fingers_in(const RigFrame& frame) {
    const auto picture = read_picture(frame.picture);
    if (!picture) {
      evaluated_.unreadable.push_back(picture.error().message);
      return {};
    }
    const ImageSize image = calibration_.image;
    if (picture->cols != image.width_px || picture->rows != image.height_px) {
      evaluated_.unreadable.push_back(fmt::format("{}: {}x{} pixels, but the calibration has {}x{}",
                                                  frame.picture.string(), picture->cols, picture->rows, image.width_px,
                                                  image.height_px));
      return {};
    }
    const auto touched = screen_points(detect(detector_, upright_.of(*picture)), model_, calibration_.screen, image);
    evaluated_.dropped += touched.dropped;
    return touched.fingers;
  }

  [[nodiscard]] std::vector<ScreenPoint> touching(const FingerObservations& fingers) const {
    std::vector<ScreenPoint> places;
    for (const FingerObservation& finger : fingers) {
      if (touches_alone(finger) && near_screen(finger.screen, calibration_.screen)) places.push_back(finger.screen);
    }
    return places;
  }

  std::vector<ScreenPoint> tracked(const FingerObservations& fingers, Timestamp time, const std::string& frame) {
    std::vector<ScreenPoint> places;
    for (const ContactState& state : tracker_.update(fingers, time)) {
      if (state.phase == Phase::down) evaluated_.contacts.push_back({state.id, frame, ""});
      if (state.phase == Phase::up) {
        const auto begun = std::ranges::find(evaluated_.contacts, state.id, &EvaluatedContact::id);
        if (begun != evaluated_.contacts.end()) begun->up = frame;
      }
      const bool more_likely_touches = state.phase != Phase::up && state.touching >= 0.5;
      if (more_likely_touches && near_screen(state.screen, calibration_.screen)) places.push_back(state.screen);
    }
    return places;
  }

  EvaluatedPart evaluated_;
  Calibration calibration_;
  AnyDetector detector_;
  TouchModel model_;
  UprightPicture upright_;
  ContactTracker tracker_;
};

Result<BorderStrip> empty_strip(const Calibration& calibration, const RigDirectory& rig) {
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
  return empty;
}

}  // namespace

Status check_algorithm(const EvalAlgorithm& algorithm) {
  if (auto known = check_choice("detector", algorithm.detector); !known) return known;
  return check_choice("model", algorithm.model);
}

Result<EvaluatedRig> calibrate_rig(const RigDirectory& recording, const EvalAlgorithm& algorithm,
                                   const std::vector<int>& calibration) {
  auto calibrated = calibrate_from_recording(recording, algorithm.model, calibration, "");
  if (!calibrated) return calibrated.error();
  EvaluatedRig rig{*std::move(calibrated), algorithm.detector, std::nullopt};
  try {
    if (algorithm.detector != "thesis") {
      auto empty = empty_strip(rig.calibration, recording);
      if (!empty) return empty.error();
      rig.empty = *std::move(empty);
    }
    (void)make_detector(rig.detector, rig.calibration, rig.empty);
  } catch (const std::invalid_argument& problem) {
    return Error{fmt::format("{}: {}", recording.path.string(), problem.what())};
  }
  return rig;
}

EvaluatedPart evaluate_part(const EvaluatedRig& rig, const RigPart& part) {
  return Evaluation(rig).run(part);
}

}  // namespace telehug
