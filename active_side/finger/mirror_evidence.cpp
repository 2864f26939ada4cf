// SPDX-License-Identifier: Apache-2.0
#include "finger/mirror_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core/matx.hpp>

#include "finger/strip_below_tip.hpp"

namespace telehug {
namespace {

constexpr int most_rows = StripBelowTip::most_rows;
constexpr int row_px = StripBelowTip::row_px;

// Where a finger's mirror image is compared with what lies beside it, in half widths from its centre line.
constexpr double inner_from = 0.3;
constexpr double inner_to = 0.8;
constexpr double outer_from = 1.2;
constexpr double outer_to = 1.75;
constexpr double rounded = 0.3;  // the mirror image's end is narrower for so many half widths: not compared

// A finger that points to the screen at an angle looks longer above the screen than below it: its centre line leans
// more there. Slopes below as multiples of those above, for steep to flat fingers.
constexpr std::array steepnesses{1.0, 1.7, 2.4, 3.5};
constexpr double straight = 0.05;    // smaller slopes are alike
constexpr double shift_step = 0.25;  // between parallel centre lines, in half widths
constexpr int fewest_rows = 6;       // that show a mirror image

// Brightness, red against blue, green against both: texts and most pictures have contrast in the first, skin in all.
const cv::Matx33f opponent{0.577F, 0.577F, 0.577F, -0.707F, 0, 0.707F, -0.408F, 0.816F, -0.408F};

// The stripe's contrast as a random walk along the rows, in grey levels.
constexpr std::array first_contrast{15.0F, 6.0F, 3.0F};  // standard deviations of the first one
constexpr std::array contrast_step{1.5F, 0.6F, 0.3F};    // and of its steps from row to row
constexpr float row_noise = 1.5F;                        // of a row's contrast on an even background
constexpr float uneven_share = 0.15F;  // of the difference between left and right: what lies between may be uneven
constexpr float one_sided = 0.6F;      // share of the difference between both edges that is taken off
constexpr int noise_window = 3;        // rows to each side from which noise is estimated
constexpr float most_per_row = 4;      // log likelihood ratio of one row
constexpr float dependence = 0.4F;     // rows and colours are no independent witnesses

// What counts as what. Log likelihood ratios.
constexpr double touching_up_to_mm = 3;
constexpr double hovering_from_mm = 5.5;
constexpr double touching_margin = 4;
constexpr double hovering_margin = 6;

constexpr float square(float x) {
  return x * x;
}

constexpr float impossible = std::numeric_limits<float>::lowest();

// How the stripe along a centre line differs from what lies left and right of it, row by row.
struct Contrasts {
  Numbered<cv::Vec3f, most_rows> contrast;
  Numbered<cv::Vec3f, most_rows> variance;
  Numbered<bool, most_rows> known;
};

// The mirror image of a finger has two edges with the same step. What differs between the two is background: it is
// taken off the step and tells how uncertain the rest is.
Contrasts contrasts_along(const StripBelowTip& strip, double begin, double lean_per_row) {
  Contrasts result;
  Numbered<cv::Vec3f, most_rows + 1> differences;  // squared, sums before each row
  Numbered<cv::Vec3f, most_rows> unevenness;
  for (int row = 0; row < strip.rows(); ++row) {
    const double centre = begin + lean_per_row * (row + 0.5);
    differences[row + 1] = differences[row];
    result.known[row] = strip.holds(row, centre - outer_to, centre + outer_to);
    if (!result.known[row]) continue;
    const auto mean = [&](double from, double to) { return opponent * strip.mean(row, centre + from, centre + to); };
    const cv::Vec3f left_outside = mean(-outer_to, -outer_from);
    const cv::Vec3f right_outside = mean(outer_from, outer_to);
    const cv::Vec3f left = mean(-inner_to, -inner_from) - left_outside;
    const cv::Vec3f right = mean(inner_from, inner_to) - right_outside;
    for (int c = 0; c < 3; ++c) {
      const float both = (left[c] + right[c]) / 2;
      const float difference = (left[c] - right[c]) / 2;
      const float remaining = std::max(0.0F, std::abs(both) - one_sided * std::abs(difference));
      result.contrast[row][c] = std::copysign(remaining, both);
      differences[row + 1][c] += difference * difference;
      const float uneven = uneven_share * (left_outside[c] - right_outside[c]);
      unevenness[row][c] = uneven * uneven;
    }
  }
  for (int row = 0; row < strip.rows(); ++row) {
    const int first = std::max(0, row - noise_window);
    const int end = std::min(strip.rows(), row + noise_window + 1);
    result.variance[row] = (differences[end] - differences[first]) * (1.0F / static_cast<float>(end - first)) +
                           unevenness[row] + cv::Vec3f::all(row_noise * row_noise);
  }
  return result;
}

// For each row, the log likelihood ratio of "a stripe from here to the strip's end" to "no stripe": a Kalman filter of
// the contrast, from the strip's end upwards, so that rows above the true end of a mirror image contradict what the
// rows below have shown.
Numbered<float, most_rows> stripe_from(const Contrasts& seen, int rows) {
  Numbered<float, most_rows> result;
  cv::Vec3f expected;
  cv::Vec3f uncertainty(square(first_contrast[0]), square(first_contrast[1]), square(first_contrast[2]));
  float sum = 0;
  for (int row = rows - 1; row >= 0; --row) {
    if (seen.known[row]) {
      float narrower = 1;
      float squares = 0;
      for (int c = 0; c < 3; ++c) {
        const float contrast = seen.contrast[row][c];
        const float noise = seen.variance[row][c];
        const float total = noise + uncertainty[c];
        const float surprise = contrast - expected[c];
        narrower *= noise / total;
        squares += contrast * contrast / noise - surprise * surprise / total;
        const float gain = uncertainty[c] / total;
        expected[c] += gain * surprise;
        uncertainty[c] = (1 - gain) * uncertainty[c] + square(contrast_step[static_cast<std::size_t>(c)]);
      }
      sum += dependence * std::clamp((std::log(narrower) + squares) / 2, -most_per_row, most_per_row);
    }
    result[row] = sum;
  }
  return result;
}

// The finger's end: half width, and where its centre line meets the tip's row.
struct FingerEnd {
  double half_width_px = 0;
  double centre_u_px = 0;
};

FingerEnd end_of(const FingerOutline& finger) {
  const double above_px = finger.tip.v_px - finger.half_width_px - finger.reference_v_px;
  double left =
      finger.centre_u_px + finger.centre_slope * above_px - (finger.half_width_px + finger.half_width_slope * above_px);
  double right =
      finger.centre_u_px + finger.centre_slope * above_px + (finger.half_width_px + finger.half_width_slope * above_px);
  if (!finger.contour.empty()) {
    left = std::numeric_limits<double>::max();
    right = std::numeric_limits<double>::lowest();
    for (const ImagePoint& point : finger.contour) {
      if (finger.tip.v_px - point.v_px > 1.4 * finger.half_width_px) continue;
      left = std::min(left, point.u_px);
      right = std::max(right, point.u_px);
    }
  }
  const double half_width_px = (right - left) / 2;
  return {half_width_px, (left + right) / 2 + finger.centre_slope * half_width_px};
}

// For each gap in rows, how likely a mirror image begins there, over all ways in which it may lean.
Numbered<float, most_rows> mirror_begins(const StripBelowTip& strip, double lean, double half_width_px) {
  Numbered<float, most_rows> result;
  result.fill(impossible);
  const auto rounded_rows = static_cast<int>(std::lround(rounded * half_width_px / row_px));
  const int gaps = strip.rows() - std::max(fewest_rows, rounded_rows + 1) + 1;
  for (const double steepness : steepnesses) {
    const double lean_per_row = lean * steepness * row_px / half_width_px;
    // A mirror image that begins at a gap follows a line through that row's middle; gaps of nearly the same line share
    // it.
    for (int first = 0; first < gaps;) {
      int end = first + 1;
      while (end < gaps && std::abs(lean_per_row) * (end - first) < shift_step)
        ++end;
      const double middle_gap = (first + end - 1) / 2.0;
      const auto likely = stripe_from(contrasts_along(strip, -lean_per_row * middle_gap, lean_per_row), strip.rows());
      for (int gap = first; gap < end; ++gap)
        result[gap] = std::max(result[gap], likely[gap + rounded_rows]);
      first = end;
    }
    if (std::abs(lean) < straight / steepnesses.back()) break;
  }
  return result;
}

}  // namespace

MirrorEvidence mirror_evidence(const cv::Mat& bgr, const FingerOutline& finger, const ScreenNormal& normal) {
  const FingerEnd end = end_of(finger);
  const bool in_picture =
      finger.tip.v_px >= 0 && finger.tip.v_px < bgr.rows && end.centre_u_px >= 0 && end.centre_u_px < bgr.cols;
  if (!(in_picture && end.half_width_px > 3 && end.half_width_px < bgr.cols && normal.px_per_mm > 0)) return {};
  const StripBelowTip strip(bgr, {end.centre_u_px, finger.tip.v_px}, normal.u_per_v, end.half_width_px);
  // Upwards the centre line moves by -slope; against the screen's normal. Below, mirrored, it leans the same way.
  const double lean = normal.u_per_v - finger.centre_slope;
  const auto likely = mirror_begins(strip, lean, end.half_width_px);

  struct Best {
    float likely = impossible;
    int gap_rows = 0;
  };
  Best touching;
  Best hovering;
  const double mm_per_row = row_px / (2 * normal.px_per_mm);
  for (int gap = 0; gap < strip.rows(); ++gap) {
    const double gap_mm = gap * mm_per_row;
    if (gap_mm > touching_up_to_mm && gap_mm < hovering_from_mm) continue;
    Best& best = gap_mm <= touching_up_to_mm ? touching : hovering;
    if (likely[gap] > best.likely) best = {likely[gap], gap};
  }
  const auto evidence = [mm_per_row](MirrorState state, const Best& best, double margin) {
    return MirrorEvidence{state, static_cast<double>(best.gap_rows * row_px), best.gap_rows * mm_per_row,
                          1 / (1 + std::exp(-margin))};
  };
  const double for_touching = static_cast<double>(touching.likely) - std::max(hovering.likely, 0.0F);
  const double for_hovering = static_cast<double>(hovering.likely) - std::max(touching.likely, 0.0F);
  if (for_touching > touching_margin) return evidence(MirrorState::touching, touching, for_touching);
  if (for_hovering > hovering_margin) return evidence(MirrorState::hovering, hovering, for_hovering);
  return {};
}

}  // namespace telehug
