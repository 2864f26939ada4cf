// SPDX-License-Identifier: Apache-2.0
#include "setup/calibration_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "setup/dot_plan.hpp"
#include "setup/dot_touches.hpp"
#include "setup/empty_screen.hpp"
#include "setup/setup_result.hpp"
#include "setup/solve_setup.hpp"

namespace telehug {
namespace {

constexpr Duration silent_after = 1s;
constexpr Duration longest_idle = 5min;

bool takes_pictures(SetupStep step) {
  return page_of(step) != SetupPage::none;
}

SessionSettings checked(SessionSettings settings) {
  const ScreenSize& screen = settings.screen;
  if (!(screen.width_mm > 0) || !(screen.height_mm > 0)) {
    throw std::invalid_argument("a calibration needs the size of the visible screen");
  }
  const std::size_t points = settings.points.size();
  if (settings.thesis && points != 0 && points != 2) {
    throw std::invalid_argument("the thesis' model is calibrated with two touches");
  }
  if (points == 1) throw std::invalid_argument("a calibration needs two touches at least");
  return settings;
}

}  // namespace

class CalibrationSession::Conversation {
 public:
  explicit Conversation(SessionSettings settings)
      : settings_(checked(std::move(settings))), empty_screen_(settings_.screen, !settings_.thesis) {
    enter(SetupStep::bright);
  }

  void look(const cv::Mat& bgr, Timestamp now) {
    if (bgr.empty() || bgr.type() != CV_8UC3 || !fits(bgr)) return no_picture(now);
    picture_at_ = now;
    state_.image = {bgr.cols, bgr.rows};
    const std::size_t taken = state_.taken;
    look_at(bgr, now);
    tell();
    // A step that is taken again and again, as going on does not help, is no progress.
    if (!active_at_ || state_.taken != taken || state_.step > furthest_) active_at_ = now;
    furthest_ = std::max(furthest_, state_.step);
    end_if_idle(now);
  }

  void no_picture(Timestamp now) {
    if (!takes_pictures(state_.step)) return;
    if (!active_at_) active_at_ = now;
    if (!picture_at_) picture_at_ = now;
    if (now - *picture_at_ >= silent_after) state_.advice = SetupAdvice::no_picture;
    end_if_idle(now);
  }

  [[nodiscard]] const SetupState& state() const { return state_; }
  [[nodiscard]] const ScreenSize& screen() const { return settings_.screen; }

  bool confirm_border() {
    if (!state_.can_confirm) return false;
    enter(SetupStep::background);
    return acted();
  }

  bool look_again() {
    if (state_.step != SetupStep::confirm_border) return false;
    enter(SetupStep::bright);
    return acted();
  }

  bool back() {
    if (!state_.can_back) return false;
    if (dots_ && dots_->back()) {
      enter(SetupStep::dots);
    } else {
      dots_.reset();
      enter(state_.step == SetupStep::confirm_border || state_.step == SetupStep::background ? SetupStep::bright
                                                                                             : SetupStep::background);
    }
    return acted();
  }

  bool skip_dot() {
    if (state_.step != SetupStep::dots || !dots_->skip()) return false;
    if (dots_->all_taken()) enter(SetupStep::solving);
    tell();
    return acted();
  }

  bool repeat(std::size_t dot) {
    if ((state_.step != SetupStep::solved && state_.step != SetupStep::dots) || !dots_->repeat(dot)) return false;
    enter(SetupStep::dots);
    return acted();
  }

  void cancel() {
    if (state_.step != SetupStep::saved) enter(SetupStep::cancelled);
  }

  [[nodiscard]] Result<CalibratedRig> calibrated() const {
    if (calibration_) return CalibratedRig{*calibration_, empty_screen_.seen().black};
    if (state_.result && !state_.result->faults.empty()) return Error{state_.result->faults.front()};
    return Error{"the calibration is not finished"};
  }

  Status save(const std::filesystem::path& path) {
    const auto rig = calibrated();
    if (!rig) return rig.error();
    if (!state_.result->good())
      return Error{fmt::format("the calibration is not saved: {}", fmt::join(state_.result->faults, "; "))};
    if (Status written = save_calibrated_rig(path, *rig); !written) return written;
    enter(SetupStep::saved);
    return Done{};
  }

 private:
  [[nodiscard]] bool fits(const cv::Mat& bgr) const {
    return state_.image.width_px == 0 || (state_.image.width_px == bgr.cols && state_.image.height_px == bgr.rows);
  }

  void look_at(const cv::Mat& bgr, Timestamp now) {
    switch (state_.step) {
      case SetupStep::bright:
        if (empty_screen_.look_bright(bgr, now, state_) == LookOutcome::done)
          enter(settings_.confirm_border ? SetupStep::confirm_border : SetupStep::background);
        break;
      case SetupStep::confirm_border:
        if (empty_screen_.look_confirm(bgr, state_) == LookOutcome::back) enter(SetupStep::bright);
        break;
      case SetupStep::background:
        if (const LookOutcome outcome = empty_screen_.look_background(bgr, now, state_); outcome == LookOutcome::back) {
          enter(SetupStep::bright);
        } else if (outcome == LookOutcome::done) {
          begin_marks_or_dots(settings_.thesis ? SetupStep::dots : SetupStep::marks);
        }
        break;
      case SetupStep::marks:
        if (const LookOutcome outcome = empty_screen_.look_marks(bgr, now, state_); outcome == LookOutcome::back) {
          enter(SetupStep::background);
          state_.advice = SetupAdvice::hands_away;
        } else if (outcome == LookOutcome::done) {
          begin_marks_or_dots(SetupStep::dots);
        }
        break;
      case SetupStep::dots:
        if (dots_->look(bgr, now, state_)) enter(SetupStep::solving);
        break;
      case SetupStep::solving:
        solve();
        break;
      case SetupStep::solved:
      case SetupStep::saved:
      case SetupStep::cancelled:
        break;
    }
  }

  void begin_marks_or_dots(SetupStep step) {
    if (step == SetupStep::dots) {
      const std::size_t count = settings_.quick ? quick_calibration_dots : full_calibration_dots;
      dots_.emplace(empty_screen_.seen(), DotSettings{settings_.thesis, count, settings_.points});
    }
    enter(step);
  }

  void enter(SetupStep step) {
    empty_screen_.forget();
    state_.step = step;
    state_.progress = 0;
    state_.finger_px.reset();
    state_.off_mm.reset();
    if (step == SetupStep::bright) {
      state_.border.reset();
      calibration_.reset();
    }
    if (step != SetupStep::solved && step != SetupStep::saved) {
      state_.result.reset();
      calibration_.reset();
    }
    state_.advice = step == SetupStep::confirm_border ? SetupAdvice::confirm : SetupAdvice::none;
    tell();
  }

  // What follows from where it stands.
  void tell() {
    state_.page = page_of(state_.step);
    state_.dots = dots_ ? dots_->dots() : std::vector<ScreenPoint>();
    state_.dot = dots_ ? dots_->dot() : 0;
    state_.camera_known = dots_ && dots_->camera_known();
    state_.can_confirm = state_.step == SetupStep::confirm_border;
    state_.can_back = state_.step != SetupStep::bright && state_.step != SetupStep::saved &&
                      state_.step != SetupStep::cancelled && state_.step != SetupStep::solving;
    state_.can_skip = state_.step == SetupStep::dots && dots_->can_skip();
    state_.can_save = state_.step == SetupStep::solved && calibration_ && state_.result->good();
  }

  void solve() {
    const auto solved = solve_setup(empty_screen_.seen(), *dots_, settings_.thesis, settings_.camera, settings_.date);
    const std::vector<bool> taken = dots_->taken();
    auto result = solved ? judge_setup(*solved, dots_->dots(), taken)
                         : failed_setup(solved.error().message, dots_->dots(), taken);
    enter(SetupStep::solved);
    if (solved) calibration_ = *solved;
    state_.advice = !result.repeat.empty() ? SetupAdvice::repeat_dots
                    : result.good()        ? SetupAdvice::good
                                           : SetupAdvice::not_good_enough;
    state_.result = std::move(result);
  }

  // Somebody is there: the five minutes begin anew.
  bool acted() {
    active_at_.reset();
    furthest_ = state_.step;
    return true;
  }

  void end_if_idle(Timestamp now) {
    if (!takes_pictures(state_.step) || !active_at_ || now - *active_at_ < longest_idle) return;
    enter(SetupStep::cancelled);
    state_.advice = SetupAdvice::idle;
  }

  SessionSettings settings_;
  EmptyScreenSteps empty_screen_;
  std::optional<DotTouches> dots_;
  std::optional<Calibration> calibration_;
  SetupState state_;
  std::optional<Timestamp> picture_at_;
  std::optional<Timestamp> active_at_;  // when it went on last
  SetupStep furthest_ = SetupStep::bright;
};

CalibrationSession::CalibrationSession(SessionSettings settings)
    : conversation_(std::make_unique<Conversation>(std::move(settings))) {}
CalibrationSession::~CalibrationSession() = default;
CalibrationSession::CalibrationSession(CalibrationSession&&) noexcept = default;
CalibrationSession& CalibrationSession::operator=(CalibrationSession&&) noexcept = default;

void CalibrationSession::look(const cv::Mat& bgr, Timestamp now) {
  conversation_->look(bgr, now);
}
void CalibrationSession::no_picture(Timestamp now) {
  conversation_->no_picture(now);
}
const SetupState& CalibrationSession::state() const noexcept {
  return conversation_->state();
}
const ScreenSize& CalibrationSession::screen() const noexcept {
  return conversation_->screen();
}
bool CalibrationSession::confirm_border() {
  return conversation_->confirm_border();
}
bool CalibrationSession::look_again() {
  return conversation_->look_again();
}
bool CalibrationSession::back() {
  return conversation_->back();
}
bool CalibrationSession::skip_dot() {
  return conversation_->skip_dot();
}
bool CalibrationSession::repeat(std::size_t dot) {
  return conversation_->repeat(dot);
}
void CalibrationSession::cancel() {
  conversation_->cancel();
}
Result<CalibratedRig> CalibrationSession::calibrated() const {
  return conversation_->calibrated();
}
Status CalibrationSession::save(const std::filesystem::path& path) {
  return conversation_->save(path);
}

}  // namespace telehug
