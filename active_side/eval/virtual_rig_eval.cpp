// SPDX-License-Identifier: Apache-2.0
#include "eval/virtual_rig_eval.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>
#include <variant>

#include "calibration/calibration_policy.hpp"
#include "capture/rig_directory.hpp"
#include "capture/virtual_rig/export_rig.hpp"
#include "capture/virtual_rig/random_rig.hpp"
#include "eval/rig_groups.hpp"
#include "eval/temporary_directory.hpp"

namespace telehug {
namespace {

using SteadyTime = std::chrono::steady_clock;

ExportSettings pictures_of(std::uint64_t seed, const VirtualRigEval& options) {
  ExportSettings pictures;
  pictures.calibration_touches = options.dots;
  pictures.sequence_frames = 0;
  pictures.single_frames = options.frames;
  pictures.hard_frames = options.hard;
  pictures.skipped_frames = static_cast<int>(seed * static_cast<std::uint64_t>(options.frames) % frame_kinds_by_turns);
  pictures.skipped_hard_frames =
      static_cast<int>(seed * static_cast<std::uint64_t>(options.hard) % hard_kinds_by_turns);
  return pictures;
}

void append(TouchScore& all, TouchScore part, const std::string& folder) {
  const auto move_into = [&](auto& to, auto& from) {
    for (auto& scored : from) {
      scored.frame = folder + "/" + scored.frame;
      to.push_back(std::move(scored));
    }
  };
  move_into(all.touches, part.touches);
  move_into(all.rests, part.rests);
  move_into(all.extras, part.extras);
}

std::vector<ScreenPoint> calibration_errors(const Calibration& calibration) {
  std::vector<ScreenPoint> errors;
  if (const auto* rig = std::get_if<RigCalibration>(&calibration.solved)) {
    for (const TouchResidual& touch : rig->solution.touches)
      errors.push_back(touch.error_mm);
  }
  return errors;
}

// A calibration that `calibrate` would not save, with its reasons; empty if it would.
std::string refusal(const Calibration& calibration) {
  const auto* const rig = std::get_if<RigCalibration>(&calibration.solved);
  return rig == nullptr ? "" : fmt::format("{}", fmt::join(judge_calibration(*rig).faults, "; "));
}

AlgorithmOutcome outcome_of(const EvalAlgorithm& algorithm, const RigDirectory& recording, bool failure_pictures) {
  AlgorithmOutcome outcome;
  try {
    const auto rig = calibrate_rig(recording, algorithm, {});
    if (!rig) {
      outcome.failure = rig.error().message;
      return outcome;
    }
    if (std::string why = refusal(rig->calibration); !why.empty()) {
      outcome.failure = std::move(why);
      return outcome;
    }
    outcome.calibration_errors_mm = calibration_errors(rig->calibration);
    for (const RigPart& part : recording.parts) {
      TouchScore score = score_touches(evaluate_part(*rig, part).found, part.truth);
      if (failure_pictures) {
        for (FailurePicture& picture : picture_failures(failures_of(score), rig->calibration, part)) {
          picture.failure.frame = part.name + "/" + picture.failure.frame;
          outcome.failures.push_back(std::move(picture));
        }
      }
      append(outcome.score, std::move(score), part.name);
    }
  } catch (const std::exception& problem) {
    outcome = {problem.what(), {}, {}, {}};
  }
  return outcome;
}

// The folder's name is another one each time, and says nothing to whoever reads the failure.
void leave_out(std::string& text, const std::string& folder) {
  for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at)) {
    const bool before_file = at + folder.size() < text.size() && text[at + folder.size()] == '/';
    text.replace(at, folder.size() + (before_file ? 1 : 0), before_file ? "" : "rig");
  }
}

}  // namespace

RigOutcome evaluate_virtual_rig(std::uint64_t seed, const VirtualRigEval& options) {
  RigOutcome outcome;
  outcome.seed = seed;
  const auto begin = SteadyTime::now();
  const auto fail = [&](const std::string& why) {
    outcome.algorithms.assign(options.algorithms.size(), {why, {}, {}, {}});
    return outcome;
  };
  try {
    const RandomRig rig = random_rig(seed);
    outcome.groups = groups_of(rig);
    outcome.screen = rig.settings.screen;
    outcome.coat = rig.group.coat;
    const TemporaryDirectory folder;
    const auto drawn = export_rig_directory(rig, folder.path(), pictures_of(seed, options));
    if (!drawn) return fail(drawn.error().message);
    const auto recording = open_rig_directory(folder.path());
    if (!recording) return fail(recording.error().message);
    outcome.drawing = SteadyTime::now() - begin;
    for (const EvalAlgorithm& algorithm : options.algorithms) {
      const bool pictures = options.failure_pictures && outcome.algorithms.empty();
      outcome.algorithms.push_back(outcome_of(algorithm, *recording, pictures));
      leave_out(outcome.algorithms.back().failure, folder.path().string());
    }
    outcome.evaluating = SteadyTime::now() - begin - outcome.drawing;
  } catch (const std::exception& problem) {
    return fail(problem.what());
  }
  return outcome;
}

}  // namespace telehug
