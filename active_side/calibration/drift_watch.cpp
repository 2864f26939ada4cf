// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/rig_residuals.hpp"

namespace telehug {
namespace {

// So many columns must lie on the line, on both halves of the picture, for it to be the border.
constexpr std::size_t least_columns = border_columns / 2;
constexpr std::size_t least_columns_a_half = 3;
constexpr double on_line_px = 0.7;

RigCamera turned(const RigCamera& camera, double pitch_deg, double roll_deg) {
  RigCameraParameters parameters = camera.parameters();
  parameters.pitch_deg += pitch_deg;
  parameters.roll_deg += roll_deg;
  return {parameters, camera.image(), camera.orientation()};
}

// Position in the picture's width, -1..1.
double part_of_width(double u_px, double width_px) {
  return 2 * u_px / (width_px - 1) - 1;
}

template <std::size_t n>
double median(std::array<double, n>& values, std::size_t count) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

}  // namespace

const char* drift_text(DriftState state) noexcept {
  switch (state) {
    case DriftState::moved_slightly:
      return "the camera moved a little and is corrected; a shift to the side can't be seen";
    case DriftState::moved:
      return "the camera was moved: calibrate again";
    case DriftState::unseen:
      return "the screen's lower edge can't be seen: light the monitor, or calibrate again if the camera was moved";
    case DriftState::steady:
      break;
  }
  return "";
}

DriftWatch::DriftWatch(const RigCamera& camera, const ScreenSize& screen, const DriftOptions& options)
    : camera_(camera), options_(options), by_pitch_{}, by_roll_{} {
  constexpr double step_deg = 0.05;
  const double width_px = camera.image().width_px;
  const auto row = [&](const RigCamera& c, double part) {
    return border_row(c, screen.height_mm, 0.5 * (part + 1) * (width_px - 1)).value_or(0);
  };
  const auto moved = [&](const RigCamera& c) {
    const double middle = row(c, 0) - row(camera, 0);
    const double apart = 0.5 * (row(c, 1) - row(camera, 1) - (row(c, -1) - row(camera, -1)));
    return Line{middle / step_deg, apart / step_deg};
  };
  by_pitch_ = moved(turned(camera, step_deg, 0));
  by_roll_ = moved(turned(camera, 0, step_deg));
}

// Theil and Sen's line: the median of all slopes, then of the levels.
bool DriftWatch::fit(const BorderShifts& shifts, double width_px, Line& line) {
  if (shifts.size() < least_columns) return false;
  std::array<double, border_columns*(border_columns - 1) / 2> slopes{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    for (std::size_t k = i + 1; k < shifts.size(); ++k) {
      const double apart = part_of_width(shifts[k].u_px, width_px) - part_of_width(shifts[i].u_px, width_px);
      if (apart > 0.1) slopes[count++] = (shifts[k].shift_px - shifts[i].shift_px) / apart;
    }
  }
  if (count == 0) return false;
  line.edges_px = median(slopes, count);
  std::array<double, border_columns> levels{};
  for (std::size_t i = 0; i < shifts.size(); ++i)
    levels[i] = shifts[i].shift_px - line.edges_px * part_of_width(shifts[i].u_px, width_px);
  line.middle_px = median(levels, shifts.size());

  std::size_t left = 0, right = 0;
  for (const BorderShift& shift : shifts) {
    const double part = part_of_width(shift.u_px, width_px);
    if (std::abs(shift.shift_px - line.middle_px - line.edges_px * part) > on_line_px) continue;
    ++(part < 0 ? left : right);
  }
  return left >= least_columns_a_half && right >= least_columns_a_half && 2 * (left + right) > shifts.size();
}

// Hysteresis: the limits of states that are not worse than the present one are lower.
DriftState DriftWatch::wanted(double size_px) const {
  const bool slightly = drift_.state == DriftState::moved_slightly;
  if (size_px > options_.moved_px) return DriftState::moved;
  if (size_px > options_.steady_px * (slightly ? options_.release_part : 1)) return DriftState::moved_slightly;
  return DriftState::steady;
}

void DriftWatch::correct(const Line& line) {
  const double determinant = by_pitch_.middle_px * by_roll_.edges_px - by_roll_.middle_px * by_pitch_.edges_px;
  drift_.pitch_deg = (line.middle_px * by_roll_.edges_px - by_roll_.middle_px * line.edges_px) / determinant;
  drift_.roll_deg = (by_pitch_.middle_px * line.edges_px - line.middle_px * by_pitch_.edges_px) / determinant;
}

const Drift& DriftWatch::update(const BorderShifts& shifts, Timestamp now) {
  if (!begun_) last_seen_ = candidate_since_ = now;
  begun_ = true;
  if (drift_.state == DriftState::moved) return drift_;
  Line line{};
  if (!fit(shifts, camera_.image().width_px, line)) {
    candidate_since_ = now;  // what is not seen does not last
    if (now - last_seen_ >= options_.unseen_after) drift_.state = DriftState::unseen;
    return drift_;
  }
  last_seen_ = now;
  drift_.middle_px = line.middle_px;
  drift_.edges_px = line.edges_px;
  const DriftState next = wanted(std::abs(line.middle_px) + std::abs(line.edges_px));
  if (next != candidate_) {
    candidate_ = next;
    candidate_since_ = now;
  }
  if (now - candidate_since_ < options_.confirm) return drift_;
  drift_.state = next;
  drift_.pitch_deg = drift_.roll_deg = 0;
  if (next == DriftState::moved_slightly) correct(line);
  return drift_;
}

RigCamera DriftWatch::corrected_camera() const {
  return turned(camera_, drift_.pitch_deg, drift_.roll_deg);
}

}  // namespace telehug
