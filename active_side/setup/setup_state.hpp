// SPDX-License-Identifier: Apache-2.0
//
// Where a set-up stands: all that a page or a terminal needs to show it. See setup_json.hpp for its form as JSON.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibration/rig_accuracy.hpp"
#include "common/units.hpp"
#include "setup/border_band.hpp"

namespace telehug {

enum class SetupStep {
  bright,          // the triangle is shown, the screen's bottom edge is looked for
  confirm_border,  // it was found: is it the right one?
  background,      // black, nobody there
  marks,           // the page of marks, nobody there
  dots,            // one dot after the other is touched
  solving,         // all are touched; the next picture's look() takes a second or two
  solved,          // see `result`
  saved,
  cancelled,
};

// What the whole screen shows.
enum class SetupPage { none, triangle, black, marks, dot };

// What to tell the person, most pressing first.
enum class SetupAdvice {
  none,
  no_picture,           // the camera is silent
  too_dark,             // the picture shows next to nothing: light, or the camera's exposure
  no_border,            // no level edge: turn the camera so that it looks down along the screen
  no_triangle,          // an edge, but no triangle on it: is it the right screen, and the whole of it?
  turn_towards_screen,  // the edge is beyond the green band
  turn_towards_user,    //
  turn_level,           // the camera is rolled
  hold_still,           // something moves: hands away, leave the camera
  page_not_seen,        // the page that should be shown is not
  hands_away,           // somebody is where nobody should be
  confirm,              // look at the border and confirm it
  touch_dot,            // no finger is seen
  finger_moves,         // rest
  finger_beside_dot,    // see `off_mm`
  finger_hovers,        // touch the screen
  hold_finger,          // right: stay
  next_dot,             // taken: go to the next one
  repeat_dots,          // see `result.repeat`
  not_good_enough,      // see `result.faults`
  good,                 // save it
  idle,                 // it has not gone on for five minutes
};

struct SeenBorder {
  std::vector<ImagePoint> points_px;  // along it, from the picture's left to its right
  std::optional<ImagePoint> vertex_px;
  double roll_deg = 0;
  bool in_band = false;
};

struct DotOutcome {
  ScreenPoint dot;
  bool skipped = false;
  bool used = false;                    // it was seen and fits the others
  std::optional<ScreenPoint> error_mm;  // where the model places it, minus where it is
};

// The predicted errors of a grid of fields over the whole screen, row by row from its top left; nothing where the
// camera doesn't see.
struct SetupErrorMap {
  int columns = 0;
  int rows = 0;
  std::vector<std::optional<PredictedError>> fields;
};

struct SetupResult {
  std::vector<DotOutcome> dots;
  std::vector<std::size_t> repeat;   // dots to take again, the most pressing first
  std::vector<std::string> faults;   // why it can't be saved; empty: it can
  std::vector<std::string> remarks;  // what could be better
  SetupErrorMap errors;              // empty for the thesis' model, which does not know
  Reach reach;
  [[nodiscard]] bool good() const noexcept { return faults.empty(); }
};

struct SetupState {
  SetupStep step = SetupStep::bright;
  SetupPage page = SetupPage::triangle;
  SetupAdvice advice = SetupAdvice::none;
  double progress = 0;                   // of what is waited for, 0 to 1
  ImageSize image;                       // of the camera's pictures; 0 x 0 until one came
  std::optional<BorderBand> green_band;  // rows of the camera's picture
  std::optional<SeenBorder> border;
  bool camera_known = false;            // the marks have told where the camera is
  std::vector<ScreenPoint> dots;        // all that are to be touched, once they are planned
  std::size_t dot = 0;                  // index of the one that is shown
  std::size_t taken = 0;                // counts up with each dot that is accepted: a moment for a sound
  std::optional<ImagePoint> finger_px;  // in the camera's picture
  std::optional<ScreenPoint> off_mm;    // finger minus dot, while one is seen and the camera is known
  std::optional<SetupResult> result;
  // What can be done now.
  bool can_confirm = false;
  bool can_back = false;
  bool can_skip = false;
  bool can_save = false;
};

// What is shown in that step.
[[nodiscard]] SetupPage page_of(SetupStep step) noexcept;

[[nodiscard]] const char* name_of(SetupStep step) noexcept;
[[nodiscard]] const char* name_of(SetupPage page) noexcept;
[[nodiscard]] const char* name_of(SetupAdvice advice) noexcept;
[[nodiscard]] SetupAdvice advice_of(CameraTurn turn) noexcept;
// A sentence in English for a terminal; pages have their own in their languages.
[[nodiscard]] const char* text_of(SetupAdvice advice) noexcept;

}  // namespace telehug
