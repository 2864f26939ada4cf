// SPDX-License-Identifier: Apache-2.0
#include "commands/calibrate_by_hand.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <ostream>
#include <utility>

#include "commands/calibration_pages.hpp"
#include "setup/calibration_session.hpp"
#include "setup/dot_plan.hpp"

namespace telehug {
namespace {

constexpr Duration longest_wait = 500ms;
constexpr Duration longest_silence = 10s;
constexpr Duration said_after = 1500ms;  // that an advice has held: a finger passes many states on its way

SessionSettings session_settings(const FrameSource& camera, const HandCalibration& wanted, const std::string& date) {
  return {wanted.screen, wanted.model == "thesis", wanted.two_dots, wanted.points, false, camera.name(), date};
}

// The conversation with the person at the screen.
class HandCalibrator {
 public:
  HandCalibrator(FrameSource& camera, const HandCalibration& wanted, const std::string& date, const Clock& clock,
                 std::ostream& instructions)
      : camera_(camera),
        clock_(clock),
        instructions_(instructions),
        session_(session_settings(camera, wanted, date)),
        pages_{wanted.model != "thesis"} {}

  Result<CalibratedRig> lead() {
    if (const Status written = pages_.write(session_.screen(), placeholders()); !written) return written.error();
    seen_ = clock_.now();
    for (;;) {
      if (const Status told = tell(); !told) return told.error();
      const SetupStep step = session_.state().step;
      if (step == SetupStep::cancelled) return Error{text_of(session_.state().advice)};
      if (step == SetupStep::solved && !repeat_one()) return session_.calibrated();
      if (const Status looked = look(); !looked) return looked.error();
    }
  }

 private:
  // Pages of dots that are not planned yet, so that a picture viewer knows all files from the beginning.
  [[nodiscard]] std::vector<ScreenPoint> placeholders() const {
    return std::vector<ScreenPoint>(full_calibration_dots,
                                    {session_.screen().width_mm / 2, session_.screen().height_mm * 0.8});
  }

  Status look() {
    const ReadOutcome outcome = camera_.read(frame_, longest_wait);
    const Timestamp now = clock_.now();
    if (outcome == ReadOutcome::frame) {
      seen_ = now;
      session_.look(frame_.bgr, now);
      return Done{};
    }
    session_.no_picture(now);
    if (now - seen_ < longest_silence && outcome != ReadOutcome::ended) return Done{};
    const std::string why = camera_.last_error();
    return Error{fmt::format("{} delivers no pictures: {}", camera_.name(), why.empty() ? "it is silent" : why)};
  }

  // What is new: another page, a touch that was taken, an advice that holds.
  Status tell() {
    const SetupState& state = session_.state();
    if (state.taken != taken_) {
      taken_ = state.taken;
      instructions_ << "\aTaken.\n";
    }
    if (state.page == SetupPage::dot && state.dots != dots_written_) {
      if (Status written = pages_.write(session_.screen(), state.dots); !written) return written;
      dots_written_ = state.dots;
      said_page_.clear();
    }
    if (const std::string page = page_text(state); page != said_page_) {
      said_page_ = page;
      if (!page.empty()) instructions_ << page << std::endl;
      said_advice_ = SetupAdvice::none;
    }
    if (state.advice != advice_) {
      advice_ = state.advice;
      advice_since_ = clock_.now();
    }
    const bool holds = clock_.now() - advice_since_ >= said_after;
    if (holds && advice_ != said_advice_ && *text_of(advice_) != '\0') {
      said_advice_ = advice_;
      instructions_ << "  " << text_of(advice_) << off_text(state) << std::endl;
    }
    return Done{};
  }

  [[nodiscard]] std::string page_text(const SetupState& state) const {
    switch (state.page) {
      case SetupPage::triangle:
        return fmt::format(
            "Show {} on the whole screen, with any picture viewer. Take your hands, and all that does "
            "not stay there, away from the screen and the desk before it.",
            CalibrationPages::triangle());
      case SetupPage::black:
        return fmt::format("Show the next one, {}: all black. Hands still away.", CalibrationPages::black());
      case SetupPage::marks:
        return fmt::format("Show the next one, {}: many dots. Hands still away.", CalibrationPages::marks());
      case SetupPage::dot:
        return fmt::format("Show {} and lay a finger on the dot, from below; leave it there until it beeps.",
                           pages_.dot(state.dot));
      case SetupPage::none:
        break;
    }
    return "";
  }

  [[nodiscard]] static std::string off_text(const SetupState& state) {
    if (state.advice != SetupAdvice::finger_beside_dot || !state.off_mm) return "";
    const ScreenPoint& off = *state.off_mm;
    return fmt::format(" ({:.0f} mm to the {}, {:.0f} mm {})", std::abs(off.x_mm), off.x_mm > 0 ? "right" : "left",
                       std::abs(off.y_mm), off.y_mm > 0 ? "below" : "above");
  }

  // Touches that do not fit are asked for again, once each; what then is still wrong is for the caller to judge.
  bool repeat_one() {
    const SetupResult& result = *session_.state().result;
    repeated_.resize(result.dots.size());
    for (const std::size_t dot : result.repeat) {
      if (repeated_[dot]) continue;
      repeated_[dot] = true;
      said_page_.clear();
      instructions_ << fmt::format("The touch of dot {} was not seen, or does not fit the others. ", dot + 1);
      return session_.repeat(dot);
    }
    return false;
  }

  FrameSource& camera_;
  const Clock& clock_;
  std::ostream& instructions_;
  CalibrationSession session_;
  CalibrationPages pages_;
  Frame frame_;
  Timestamp seen_;  // the last picture
  std::size_t taken_ = 0;
  std::string said_page_;
  std::vector<ScreenPoint> dots_written_;
  SetupAdvice advice_ = SetupAdvice::none;
  SetupAdvice said_advice_ = SetupAdvice::none;
  Timestamp advice_since_;
  std::vector<bool> repeated_;
};

}  // namespace

Result<std::vector<ScreenPoint>> parse_points(const std::vector<std::string>& texts) {
  std::vector<ScreenPoint> points;
  for (const std::string& text : texts) {
    ScreenPoint point;
    int end = 0;
    const int read = std::sscanf(text.c_str(), "%lf,%lf%n", &point.x_mm, &point.y_mm, &end);
    if (read != 2 || text.c_str()[end] != '\0' || !std::isfinite(point.x_mm) || !std::isfinite(point.y_mm)) {
      return Error{fmt::format("--point {} is not X,Y in mm, such as 190,100", text)};
    }
    points.push_back(point);
  }
  if (points.size() == 1) return Error{"give two --point or more, or none"};
  return points;
}

Result<CalibratedRig> calibrate_by_hand(FrameSource& camera, const HandCalibration& wanted, const std::string& date,
                                        const Clock& clock, std::ostream& instructions) {
  if (!(wanted.screen.width_mm > 0) || !(wanted.screen.height_mm > 0)) {
    return Error{"say how large the visible screen is: --width-mm and --height-mm, or [rig] in the configuration"};
  }
  if (wanted.model == "thesis" && !wanted.points.empty() && wanted.points.size() != 2)
    return Error{"the thesis' model is calibrated with two touches: give two --point"};
  if (const Status opened = camera.open(); !opened) return opened.error();
  return HandCalibrator(camera, wanted, date, clock, instructions).lead();
}

}  // namespace telehug
