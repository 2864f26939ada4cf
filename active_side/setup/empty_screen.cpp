// SPDX-License-Identifier: Apache-2.0
#include "setup/empty_screen.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "setup/touch_watch.hpp"

namespace telehug {
namespace {

constexpr Duration bright_still = 600ms;
constexpr Duration without_triangle = 4s;  // then another line will do, if the person agrees
constexpr Duration without_black = 15s;    // long enough to show a page by hand
constexpr Duration background_still = 1s;
constexpr Duration marks_still = 500ms;
constexpr int looks_per_search = 6;  // pictures, in which edges are searched for once
constexpr double moved_px = 6;       // of the border: the camera was turned
constexpr int most_tries = 4;        // of finding marks: then it goes on without
constexpr int most_backgrounds = 3;  // that are taken before somebody who seems to be there is believed to be furniture
// Chosen, not measured: the lightest tenth of a picture with a white page in it is well above.
constexpr double dark_bright_page = 60;
constexpr double black_part = 0.8;   // of what the white page was, compared with the rest of the picture
constexpr double least_black = 0.1;  // of the screen: the triangle was black already
// Chosen, not measured: little more than the noise of a covered lens.
constexpr double dark_desk = 6;

double percentile(const cv::Mat& bgr, double part) {
  cv::Mat small, grey;
  cv::resize(bgr, small, {160, 90}, 0, 0, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  std::vector<uchar> levels(grey.begin<uchar>(), grey.end<uchar>());
  const auto at = levels.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(levels.size() - 1));
  std::nth_element(levels.begin(), at, levels.end());
  return *at;
}

double waited(Duration still, Duration wanted) {
  return std::clamp(std::chrono::duration<double>(still) / std::chrono::duration<double>(wanted), 0.0, 1.0);
}

double middle_row(const BorderLine& line, const cv::Mat& bgr) {
  return line.v_at(0.5 * bgr.cols);
}

// Grey levels of fields of about 16 x 16 px in pictures of 1280 columns.
cv::Mat fields_of(const cv::Mat& bgr) {
  constexpr int columns = 80;
  cv::Mat small, grey;
  cv::resize(bgr, small, {columns, std::max(2, columns * bgr.rows / bgr.cols)}, 0, 0, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

cv::Mat EmptyScreen::turned(const cv::Mat& bgr) const {
  if (!upside_down) return bgr;
  constexpr int about_the_middle_row = 0;
  cv::Mat flipped;
  cv::flip(bgr, flipped, about_the_middle_row);
  return flipped;
}

EmptyScreenSteps::EmptyScreenSteps(const ScreenSize& screen, bool may_be_upside_down)
    : may_be_upside_down_(may_be_upside_down) {
  seen_.screen = screen;
}

void EmptyScreenSteps::forget() {
  still_.forget();
  looks_ = 0;
  tries_ = 0;
  asked_at_.reset();
}

// The triangle's line as the picture is, then upside down; the triangle without a line; else the longest line, or none.
void EmptyScreenSteps::find_border(const cv::Mat& bgr, SetupState& state) {
  border_found_ = false;
  const auto look = [&](BorderChoice choice, bool upside_down) {
    if (border_found_ || (upside_down && !may_be_upside_down_)) return;
    seen_.upside_down = upside_down;
    const auto found = find_screen_border(seen_.turned(bgr), choice);
    border_found_ = found.ok();
    seen_.border = found ? *found : ScreenBorder{};
  };
  for (const BorderChoice choice : {BorderChoice::triangle, BorderChoice::triangle_alone}) {
    look(choice, false);
    look(choice, true);
  }
  look(BorderChoice::longest, false);
  tell_border(state);
}

void EmptyScreenSteps::tell_border(SetupState& state) const {
  constexpr int points = 9;
  state.green_band = green_band(seen_.screen, state.image, seen_.upside_down);
  state.border.reset();
  if (!border_found_) return;
  const auto in_picture = [&](double u_px, double v_px) {
    return ImagePoint{u_px, seen_.upside_down ? state.image.height_px - 1 - v_px : v_px};
  };
  SeenBorder border;
  for (int i = 0; i < points; ++i) {
    const double u = (state.image.width_px - 1) * static_cast<double>(i) / (points - 1);
    border.points_px.push_back(in_picture(u, seen_.border.line.v_at(u)));
  }
  if (const auto& vertex = seen_.border.vertex) border.vertex_px = in_picture(vertex->u_px, vertex->v_px);
  border.roll_deg = roll_deg(seen_.border.line);
  const double middle = border.points_px[points / 2].v_px;
  border.in_band = middle >= state.green_band->top_px && middle <= state.green_band->bottom_px;
  state.border = std::move(border);
}

LookOutcome EmptyScreenSteps::look_bright(const cv::Mat& bgr, Timestamp now, SetupState& state) {
  still_.look(bgr, now);
  if (looks_++ % looks_per_search == 0) find_border(bgr, state);
  state.progress = waited(still_.still_for(), bright_still);

  const bool at_the_triangle = border_found_ && seen_.border.vertex;
  const bool too_dark = percentile(bgr, 0.9) < dark_bright_page;
  state.advice = SetupAdvice::none;
  if (too_dark) {
    state.advice = SetupAdvice::too_dark;
  } else if (!border_found_) {
    state.advice = SetupAdvice::no_border;
  } else if (!at_the_triangle) {
    state.advice = SetupAdvice::no_triangle;
  } else {
    // In turned pictures, so that the band is that of upright ones.
    const BorderBand band = green_band(seen_.screen, state.image, false);
    const CameraTurn turn = turn_wanted(seen_.border.line, band, state.image, false);
    state.advice = advice_of(turn);
    if (turn == CameraTurn::none && still_.still_for() < bright_still) state.advice = SetupAdvice::hold_still;
  }
  if (still_.still_for() < (at_the_triangle ? bright_still : without_triangle) || too_dark || !border_found_)
    return LookOutcome::wait;
  seen_.triangle = still_.picture();
  const EmptyScreen before = seen_;
  find_border(seen_.triangle, state);
  if (at_the_triangle && !seen_.border.vertex) {  // just not in that picture
    seen_ = before;
    tell_border(state);
  }
  white_fields_ = fields_of(seen_.turned(seen_.triangle));
  return LookOutcome::done;
}

LookOutcome EmptyScreenSteps::look_confirm(const cv::Mat& bgr, SetupState& state) {
  state.progress = 1;
  if (looks_++ % looks_per_search != 0 || !seen_.border.vertex) return LookOutcome::wait;
  // As it was found: the line and the triangle alone see the vertex some pixels apart.
  const bool alone = seen_.border.length_px == 0;
  const auto now = find_screen_border(seen_.turned(bgr), alone ? BorderChoice::triangle_alone : BorderChoice::triangle);
  const auto row = [&](const ScreenBorder& border) {
    return alone ? border.vertex->v_px : middle_row(border.line, bgr);
  };
  const bool moved = now && std::abs(row(*now) - row(seen_.border)) > moved_px * bgr.cols / 1280;
  return moved ? LookOutcome::back : LookOutcome::wait;
}

// Has enough of the part that shows the screen (the picture's lower half where no border is known) become darker than
// it was with the white page? The camera's exposure is what the rest of the picture has become.
bool EmptyScreenSteps::sees_black(const cv::Mat& bgr) const {
  const cv::Mat now = fields_of(seen_.turned(bgr));
  const double edge = border_found_ ? middle_row(seen_.border.line, bgr) : 0.5 * bgr.rows;
  const int first = std::clamp(static_cast<int>(edge * now.rows / bgr.rows), 1, now.rows - 1);
  const auto change = [&](int row, int column) {
    return (now.at<uchar>(row, column) + 2.0) / (white_fields_.at<uchar>(row, column) + 2.0);
  };
  std::vector<double> rest;
  for (int row = 0; row < first; ++row) {
    for (int column = 0; column < now.cols; ++column)
      rest.push_back(change(row, column));
  }
  std::nth_element(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(rest.size() / 2), rest.end());
  const double exposure = rest[rest.size() / 2];
  int darker = 0;
  for (int row = first; row < now.rows; ++row) {
    for (int column = 0; column < now.cols; ++column)
      darker += change(row, column) < black_part * exposure ? 1 : 0;
  }
  return darker > least_black * (now.rows - first) * now.cols;
}

LookOutcome EmptyScreenSteps::look_background(const cv::Mat& bgr, Timestamp now, SetupState& state) {
  still_.look(bgr, now);
  state.progress = waited(still_.still_for(), background_still);
  if (!asked_at_) asked_at_ = now;
  if (!sees_black(bgr)) {
    still_.forget();
    state.progress = 0;
    state.advice = SetupAdvice::page_not_seen;
    // What was taken for the screen's edge is none, it seems.
    return !seen_.border.vertex && now - *asked_at_ >= without_black ? LookOutcome::back : LookOutcome::wait;
  }
  if (percentile(bgr, 0.9) < dark_desk) {
    state.advice = SetupAdvice::too_dark;
    return LookOutcome::wait;
  }
  state.advice = state.progress < 0.3 ? SetupAdvice::hold_still : SetupAdvice::none;
  if (still_.still_for() < background_still) return LookOutcome::wait;
  seen_.black = still_.picture();
  ++backgrounds_;
  return LookOutcome::done;
}

void EmptyScreenSteps::find_cameras() {
  EmptyScreenPictures pictures{seen_.screen, seen_.border, seen_.turned(seen_.black), seen_.turned(seen_.marks)};
  seen_.cameras = cameras_from_marks(pictures, seen_.upside_down);
  if (!seen_.cameras.empty() || !seen_.border.vertex) return;
  // What looked like the triangle was something else, perhaps.
  pictures.border.vertex.reset();
  seen_.cameras = cameras_from_marks(pictures, seen_.upside_down);
  if (!seen_.cameras.empty()) seen_.border.vertex.reset();
}

LookOutcome EmptyScreenSteps::look_marks(const cv::Mat& bgr, Timestamp now, SetupState& state) {
  still_.look(bgr, now);
  state.progress = waited(still_.still_for(), marks_still);
  if (still_.still_for() < marks_still) {
    if (tries_ == 0) state.advice = state.progress < 0.3 ? SetupAdvice::hold_still : SetupAdvice::none;
    return LookOutcome::wait;
  }
  seen_.marks = still_.picture();
  still_.forget();
  find_cameras();
  if (seen_.cameras.empty()) {
    state.advice = SetupAdvice::page_not_seen;
    return ++tries_ < most_tries ? LookOutcome::wait : LookOutcome::done;
  }
  try {
    TouchWatch watch(as_calibration(seen_.cameras.front().solution.model, seen_.screen), seen_.turned(seen_.black));
    const bool somebody = watch.look(seen_.turned(seen_.marks), {0, 0}).hand_there;
    if (somebody && backgrounds_ < most_backgrounds) return LookOutcome::back;
  } catch (const std::invalid_argument&) {
    seen_.cameras.clear();  // a camera that sees no finger is none
    return ++tries_ < most_tries ? LookOutcome::wait : LookOutcome::done;
  }
  return LookOutcome::done;
}

}  // namespace telehug
