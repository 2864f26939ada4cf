// SPDX-License-Identifier: Apache-2.0
#include "doubles/random_set_up.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>
#include <variant>

#include "calibration/calibration.hpp"
#include "capture/virtual_rig/random_frame.hpp"
#include "capture/virtual_rig/random_rig.hpp"
#include "doubles/rig_with_pages.hpp"
#include "pictures/picture_file.hpp"
#include "setup/calibration_session.hpp"

namespace telehug {
namespace {

constexpr int frames_per_s = 30;
constexpr double longest_s = 120;
constexpr double patience_s = 8;  // of a person whose finger lies on a dot
constexpr int most_attempts = 3;  // of touching a dot
constexpr int most_repeats = 3;   // of a dot that is asked for again
// A mean error above these makes fields of the grid be touched that were not meant.
constexpr ScreenPoint wrong_mm{1.5, 4};

class Toucher {
 public:
  Toucher(const RandomRig& rig, std::uint64_t seed) : rig_(rig), seed_(seed) {}

  std::optional<HandPose> operator()(const SetupState& state, double asked_s) {
    if (state.step != SetupStep::dots) {
      left_.reset();
      return std::nullopt;
    }
    const std::pair asked(state.taken, state.dots[state.dot].x_mm);
    if (asked != asked_) {
      asked_ = asked;
      left_ = std::exchange(at_, std::nullopt);
      attempts = 1;
    }
    const double turn_s = asked_s - (attempts - 1) * patience_s;
    if (turn_s >= patience_s) {
      ++attempts;
      left_ = std::exchange(at_, std::nullopt);
    }
    return at(state.dots[state.dot], asked_s - (attempts - 1) * patience_s);
  }

  int attempts = 1;  // of touching the dot that is asked for

 private:
  std::optional<HandPose> at(const ScreenPoint& dot, double asked_s) {
    constexpr double leave_s = 0.6, comes_s = 1.4, touch_s = 2.2;
    if (asked_s < leave_s) {
      if (left_ && asked_s >= leave_s / 2) left_->finger.hover_mm = 60;
      return left_;
    }
    if (asked_s < comes_s) return std::nullopt;
    const double hover_mm = asked_s < touch_s ? std::max(5.0, std::round((touch_s - asked_s) * 10) * 8) : 0;
    HandPose pose = random_pose(rig_.settings, rig_.users.front(), {dot, 0},
                                seed_ * 100 + asked_.first * 5 + static_cast<std::uint64_t>(attempts));
    constexpr std::array tremor_mm{-0.3, 0.0, 0.3, 0.0};
    const auto step = static_cast<std::size_t>(asked_s * 10);
    pose.finger = {{dot.x_mm + (hover_mm > 0 ? 0 : tremor_mm[step % tremor_mm.size()]), dot.y_mm}, hover_mm};
    at_ = pose;
    return pose;
  }

  const RandomRig& rig_;
  std::uint64_t seed_;
  std::pair<std::size_t, double> asked_{0, -1};
  std::optional<HandPose> at_;
  std::optional<HandPose> left_;  // the hand at the last dot
};

class Trial {
 public:
  Trial(std::uint64_t seed, const SetUpTrial& wanted)
      : wanted_(wanted),
        seed_(seed),
        drawn_(still(random_rig(seed), wanted.turned_deg)),
        rig_(drawn_.settings),
        session_(settings()),
        set_up_(rig_, session_),
        toucher_(drawn_, seed) {}

  SetUpOutcome run() {
    outcome_.seed = seed_;
    bool ended = false;
    while (!ended && set_up_.seconds() < longest_s && session_.state().step != SetupStep::cancelled) {
      if (session_.state().step == SetupStep::solved) {
        ended = !repeat_one();
        continue;
      }
      set_up_.step([this](const SetupState& state, double asked_s) { return toucher_(state, asked_s); });
      note();
      if (toucher_.attempts > lifts_) ++outcome_.lifted;
      lifts_ = toucher_.attempts;
      if (toucher_.attempts > most_attempts && session_.skip_dot()) toucher_.attempts = 1;
    }
    judge();
    return std::move(outcome_);
  }

 private:
  static RandomRig still(RandomRig rig, double turned_deg) {
    rig.settings.camera.pitch_deg += turned_deg;
    rig.settings.motion = ScreenMotion::still;
    return rig;
  }

  [[nodiscard]] SessionSettings settings() const {
    SessionSettings settings;
    settings.screen = drawn_.settings.screen;
    settings.quick = wanted_.quick;
    settings.confirm_border = false;
    settings.camera = "virtual";
    settings.date = "2026-01-01T00:00:00Z";
    return settings;
  }

  bool repeat_one() {
    const SetupResult& result = *session_.state().result;
    if (wanted_.trace) print_touches(result);
    if (result.good() && result.repeat.empty()) return false;
    for (const std::size_t dot : result.repeat) {
      if (++repeats_[dot] > most_repeats) continue;
      ++outcome_.repeated;
      return session_.repeat(dot);
    }
    return false;
  }

  void print_touches(const SetupResult& result) const {
    for (const DotOutcome& dot : result.dots) {
      const ScreenPoint error = dot.error_mm.value_or(ScreenPoint{});
      fmt::print("{} {:6.2f} s    dot at {:.0f}, {:.0f} mm {}: {:.1f} {:.1f} mm beside it\n", seed_, set_up_.seconds(),
                 dot.dot.x_mm, dot.dot.y_mm,
                 dot.skipped ? "left out"
                 : dot.used  ? "used"
                             : "not used",
                 error.x_mm, error.y_mm);
    }
  }

  void note() {
    const SetupState& state = session_.state();
    const std::string now = fmt::format("{} {} {}", name_of(state.step), state.step == SetupStep::dots ? state.dot : 0,
                                        name_of(state.advice));
    if (now == noted_) return;
    noted_ = now;
    if (!wanted_.trace) return;
    const ScreenPoint off = state.off_mm.value_or(ScreenPoint{});
    fmt::print("{} {:6.2f} s  {:<40} off {:.1f} {:.1f}{}\n", seed_, set_up_.seconds(), now, off.x_mm, off.y_mm,
               state.camera_known ? "" : "  no camera");
    std::fflush(stdout);
  }

  void judge() {
    const SetupState& state = session_.state();
    outcome_.seconds = set_up_.seconds();
    outcome_.said = noted_;
    if (const auto found = session_.calibrated(); found.ok()) {
      const auto& solved = std::get<RigCalibration>(found->calibration.solved);
      outcome_.errors = rig_.errors(solved).mean;
    }
    if (state.step == SetupStep::solved) {
      outcome_.end = SetUpEnd::refused;
      for (const DotOutcome& dot : state.result->dots)
        outcome_.dots_used += dot.used ? 1 : 0;
      if (state.can_save) {
        const bool right = outcome_.errors->x_mm < wrong_mm.x_mm && outcome_.errors->y_mm < wrong_mm.y_mm;
        outcome_.end = right ? SetUpEnd::good : SetUpEnd::wrong;
      }
      outcome_.said = fmt::format("{}", fmt::join(state.result->faults, "; "));
    }
    if (outcome_.end != SetUpEnd::good && !wanted_.pictures.empty())
      (void)write_png(fmt::format("{}/{}.png", wanted_.pictures, seed_), set_up_.picture());
  }

  SetUpTrial wanted_;
  std::uint64_t seed_;
  RandomRig drawn_;
  RigWithPages rig_;
  CalibrationSession session_;
  RenderedSetUp set_up_;
  Toucher toucher_;
  int lifts_ = 1;
  std::map<std::size_t, int> repeats_;
  std::string noted_;
  SetUpOutcome outcome_;
};

}  // namespace

const char* SetUpOutcome::name() const noexcept {
  switch (end) {
    case SetUpEnd::good:
      return "good";
    case SetUpEnd::wrong:
      return "WRONG";
    case SetUpEnd::refused:
      return "refused";
    case SetUpEnd::stuck:
      break;
  }
  return "stuck";
}

SetUpOutcome set_up_random_rig(std::uint64_t seed, const SetUpTrial& trial) {
  return Trial(seed, trial).run();
}

}  // namespace telehug
