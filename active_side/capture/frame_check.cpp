// SPDX-License-Identifier: Apache-2.0
#include "capture/frame_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

namespace telehug {
namespace {

constexpr int black = 16;  // video's own black level
constexpr int white = 250;
constexpr double nearly_all = 0.995;  // some samples may fall on hot pixels
constexpr int clear_difference = 16;  // grey levels; well above a webcam's noise
// Rows of samples that a torn picture shares with something that it should not; 3 of 24 are an eighth of the picture.
constexpr std::size_t least_torn_rows = 3;
// A part that differed from the picture before in so many frames on end does not stand still by chance.
constexpr int lively_frames = 8;
constexpr float reference_weight = 1 / 16.0F;
constexpr double looks_alike = 0.8;  // correlation
constexpr double looks_different = 0.5;

std::uint32_t packed(const cv::Vec3b& colour) {
  return static_cast<std::uint32_t>(colour[0] | colour[1] << 8 | colour[2] << 16);
}

// Dark and bright parts are cut off at 0 and 255 and stand still by themselves.
constexpr bool is_cut_off(std::uint8_t grey) {
  return grey <= 2 || grey >= 253;
}

// Correlation of two grids, -1..1; `order(i)` is the sample of b that belongs to sample i of a. 0 if one is flat.
template <typename Order>
double correlation(std::span<const std::uint8_t> a, std::span<const float> b, Order order) {
  const auto count = static_cast<float>(a.size());
  float sum_a = 0;
  float sum_b = 0;
  float sum_aa = 0;
  float sum_bb = 0;
  float sum_ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto x = static_cast<float>(a[i]);
    const float y = b[order(i)];
    sum_a += x;
    sum_b += y;
    sum_aa += x * x;
    sum_bb += y * y;
    sum_ab += x * y;
  }
  const double spread = static_cast<double>(sum_aa - sum_a * sum_a / count) * (sum_bb - sum_b * sum_b / count);
  return spread > 1 ? (sum_ab - sum_a * sum_b / count) / std::sqrt(spread) : 0;
}

}  // namespace

FrameCheck::FrameCheck(ImageSize image, BorderPlace border, const FrameCheckOptions& options)
    : options_(options), image_(image) {
  for (int c = 0; c < columns; ++c)
    u_px_[static_cast<std::size_t>(c)] = (2 * c + 1) * image.width_px / (2 * columns);
  for (int r = 0; r < rows; ++r)
    v_px_[static_cast<std::size_t>(r)] = (2 * r + 1) * image.height_px / (2 * rows);
  for (std::size_t i = 0; i < samples; ++i) {
    const int u_px = u_px_[i % columns];
    on_desk_[i] = v_px_[i / columns] < border.v0_px + border.slope * u_px;
  }
}

FrameFindings FrameCheck::check(const cv::Mat& bgr, RowRange filled) {
  FrameFindings findings;
  if (bgr.type() != CV_8UC3 || bgr.cols != image_.width_px || bgr.rows != image_.height_px) {
    findings.verdict = FrameVerdict::other_size;
    return findings;
  }
  here_ = sample_rows(filled);
  compared_.first = std::max(here_.first, before_.first);
  compared_.end = std::max(compared_.first, std::min(here_.end, before_.end));
  sample(bgr);
  compare_rows();
  const auto same = std::span(same_row_).subspan(compared_.first, compared_.count());
  findings.duplicate = !same.empty() && std::ranges::all_of(same, [](bool is_same) { return is_same; });
  duplicates_ = findings.duplicate ? duplicates_ + 1 : 0;
  findings.desk_change = desk_change();
  settling_ =
      findings.desk_change >= options_.light_change_from ? options_.settle_frames + 1 : std::max(0, settling_ - 1);
  findings.settling = settling_ > 0;

  if (is_blank()) {
    findings.verdict = FrameVerdict::blank;
  } else if (options_.frozen_after > 0 && duplicates_ >= options_.frozen_after) {
    findings.verdict = FrameVerdict::frozen;
  } else if (is_torn()) {
    findings.verdict = FrameVerdict::torn;
  } else if (is_turned()) {
    findings.verdict = FrameVerdict::turned;
  }
  if (findings.verdict != FrameVerdict::torn) follow_rows();
  if (findings.verdict == FrameVerdict::good) follow_reference();
  colours_before_ = colours_;
  greys_before_ = greys_;
  before_ = here_;
  return findings;
}

FrameCheck::SampleRows FrameCheck::sample_rows(RowRange picture_rows) const {
  SampleRows found;
  while (found.first < rows && v_px_[found.first] < picture_rows.first)
    ++found.first;
  found.end = found.first;
  while (found.end < rows && v_px_[found.end] < picture_rows.end)
    ++found.end;
  return found;
}

void FrameCheck::sample(const cv::Mat& bgr) {
  std::size_t i = here_.first * columns;
  for (std::size_t r = here_.first; r < here_.end; ++r) {
    const auto* row = bgr.ptr<cv::Vec3b>(v_px_[r]);
    for (const int u_px : u_px_) {
      const cv::Vec3b colour = row[u_px];
      colours_[i] = packed(colour);
      greys_[i] = static_cast<std::uint8_t>((colour[0] + 2 * colour[1] + colour[2]) / 4);
      ++i;
    }
  }
}

bool FrameCheck::is_blank() const {
  const auto greys = std::span(greys_).subspan(here_.first * columns, here_.count() * columns);
  const auto colours = std::span(colours_).subspan(here_.first * columns, greys.size());
  if (greys.empty()) return false;
  const auto nearly_everywhere = [&](auto count) {
    return static_cast<double>(count) >= nearly_all * static_cast<double>(greys.size());
  };
  return nearly_everywhere(std::ranges::count_if(greys, [](auto grey) { return grey <= black; })) ||
         nearly_everywhere(std::ranges::count_if(greys, [](auto grey) { return grey >= white; })) ||
         nearly_everywhere(std::ranges::count(colours, colours[colours.size() / 2]));
}

void FrameCheck::compare_rows() {
  for (std::size_t row = compared_.first; row < compared_.end; ++row) {
    const auto* first = colours_.data() + row * columns;
    same_row_[row] = std::equal(first, first + columns, colours_before_.data() + row * columns);
  }
}

bool FrameCheck::is_torn() const {
  // Filled with one colour from some row on.
  if (here_.count() == 0) return false;
  std::size_t filled = 0;
  const std::size_t last = here_.end * columns - 1;
  const std::uint32_t filling = colours_[last];
  while (filled < here_.count()) {
    const auto* first = colours_.data() + (here_.end - 1 - filled) * columns;
    if (!std::all_of(first, first + columns, [&](std::uint32_t colour) { return colour == filling; })) break;
    ++filled;
  }
  if (filled >= least_torn_rows && !is_cut_off(greys_[last])) return true;

  // Part of it still shows the picture before, although that part is alive and the other part has changed.
  const auto stands_still = [&](std::size_t row) { return same_row_[row] && lively_for_[row] >= lively_frames; };
  const std::size_t count = compared_.count();
  std::size_t above = 0;
  while (above < count && stands_still(compared_.first + above))
    ++above;
  std::size_t below = 0;
  while (below < count && stands_still(compared_.end - 1 - below))
    ++below;
  const auto changed =
      static_cast<std::size_t>(std::ranges::count(std::span(same_row_).subspan(compared_.first, count), false));
  const std::size_t old = std::max(above, below);
  return old >= least_torn_rows && old < count && 2 * changed > count - old;
}

void FrameCheck::follow_rows() {
  for (std::size_t row = 0; row < rows; ++row) {
    const bool changed = row >= compared_.first && row < compared_.end && !same_row_[row];
    lively_for_[row] = changed ? std::min(lively_for_[row] + 1, lively_frames) : 0;
  }
}

double FrameCheck::desk_change() const {
  int changed = 0;
  int desk_samples = 0;
  for (std::size_t i = compared_.first * columns; i < compared_.end * columns; ++i) {
    desk_samples += on_desk_[i] ? 1 : 0;
    changed += on_desk_[i] && std::abs(greys_[i] - greys_before_[i]) > clear_difference ? 1 : 0;
  }
  return desk_samples > 0 ? static_cast<double>(changed) / desk_samples : 0;
}

bool FrameCheck::is_turned() {
  if (reference_frames_ < reference_ready) return false;
  const std::size_t first = here_.first * columns;
  const std::size_t count = here_.count() * columns;
  const double upright = correlation(std::span(greys_).subspan(first, count),
                                     std::span(reference_).subspan(first, count), [](std::size_t i) { return i; });
  looks_different_ = turned_ || upright < looks_different;
  if (!looks_different_) return false;
  if (here_.count() < rows) return turned_;
  const auto mirrored = [](std::size_t i) { return i / columns * columns + columns - 1 - i % columns; };
  const double best =
      std::max({correlation(greys_, reference_, [](std::size_t i) { return samples - 1 - i; }),
                correlation(greys_, reference_, mirrored),
                correlation(greys_, reference_, [&](std::size_t i) { return samples - 1 - mirrored(i); })});
  turned_ = turned_ ? upright < looks_different || best > upright : best >= looks_alike;
  return turned_;
}

void FrameCheck::follow_reference() {
  const float weight = reference_frames_ == 0 ? 1.0F : reference_weight;
  for (std::size_t i = here_.first * columns; i < here_.end * columns; ++i)
    reference_[i] += weight * (static_cast<float>(greys_[i]) - reference_[i]);
  if (here_.count() == rows) reference_frames_ = std::min(reference_frames_ + 1, reference_ready);
}

}  // namespace telehug
