// SPDX-License-Identifier: Apache-2.0
#include "finger/finger_colours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace telehug {
namespace {

constexpr float twice_variance = 2 * 22 * 22;  // of a colour about its nearest known one: noise, texture, shading
constexpr float darkest_shade = 0.55F;         // a finger's colour gets so much darker, or
constexpr float brightest_shade = 1.12F;       // lighter, and is still its own,
constexpr float shade_cost = 0.25F;            // at a price
constexpr Colour nowhere{-500, -500, -500};    // beside the picture
constexpr std::size_t finger_colours = 4;
constexpr std::size_t colours_beside = 6;
constexpr std::size_t tip_colours = 4;
constexpr int cluster_rounds = 5;
constexpr std::size_t most_samples = 1024;

float brightness(const Colour& c) {
  return c.b + c.g + c.r;
}

float shaded_distance2(const Colour& seen, const Colour& known) {
  const float along = seen.b * known.b + seen.g * known.g + seen.r * known.r;
  const float length2 = std::max(known.b * known.b + known.g * known.g + known.r * known.r, 1.0F);
  const float shade = std::clamp(along / length2, darkest_shade, brightest_shade);
  const Colour shaded{shade * known.b, shade * known.g, shade * known.r};
  return distance2(seen, shaded) + shade_cost * (1 - shade) * (1 - shade) * length2;
}

Colour nearest_pixel(const cv::Mat& bgr, double u, int v) {
  const auto& pixel = bgr.at<cv::Vec3b>(v, static_cast<int>(std::lround(u)));
  return {static_cast<float>(pixel[0]), static_cast<float>(pixel[1]), static_cast<float>(pixel[2])};
}

}  // namespace

Colour colour_at(const cv::Mat& bgr, float u, float v) noexcept {
  const auto column = static_cast<int>(u);
  const auto row = static_cast<int>(v);
  const float fu = u - static_cast<float>(column);
  const float fv = v - static_cast<float>(row);
  const std::uint8_t* const above = bgr.ptr<std::uint8_t>(row) + 3 * column;
  const std::uint8_t* const below = above + bgr.step[0];
  const float w00 = (1 - fu) * (1 - fv);
  const float w01 = fu * (1 - fv);
  const float w10 = (1 - fu) * fv;
  const float w11 = fu * fv;
  const auto mixed = [&](int c) { return w00 * above[c] + w01 * above[c + 3] + w10 * below[c] + w11 * below[c + 3]; };
  return {mixed(0), mixed(1), mixed(2)};
}

FingerColours::FingerColours(ImageSize largest)
    : row_sides_(static_cast<std::size_t>(largest.height_px)), known_(std::size_t{1} << 15U) {
  samples_.reserve(most_samples);
}

void FingerColours::forget() noexcept {
  ++generation_;
}

// K-means (Lloyd 1982), begun with quantiles of brightness, so that the same samples give the same palette.
void FingerColours::cluster(std::vector<Colour>& samples, std::size_t count, Palette& palette) {
  if (samples.empty()) return;
  std::sort(samples.begin(), samples.end(),
            [](const Colour& x, const Colour& y) { return brightness(x) < brightness(y); });
  const std::size_t first = palette.size();
  for (std::size_t k = 0; k < count && palette.size() < palette.capacity(); ++k)
    palette.push_back(samples[(samples.size() - 1) * (2 * k + 1) / (2 * count)]);
  const std::span<Colour> own(palette.data() + first, palette.size() - first);
  for (int round = 0; round < cluster_rounds; ++round) {
    std::array<Colour, 8> sum{};
    std::array<float, 8> members{};
    for (const Colour& sample : samples) {
      std::size_t nearest = 0;
      float least = std::numeric_limits<float>::max();
      for (std::size_t k = 0; k < own.size(); ++k) {
        const float d = distance2(sample, own[k]);
        nearest = d < least ? k : nearest;
        least = std::min(d, least);
      }
      sum[nearest].b += sample.b;
      sum[nearest].g += sample.g;
      sum[nearest].r += sample.r;
      members[nearest] += 1;
    }
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (members[k] > 0) own[k] = {sum[k].b / members[k], sum[k].g / members[k], sum[k].r / members[k]};
    }
  }
}

void FingerColours::learn(const cv::Mat& bgr, const FingerAxis& axis, int last_row,
                          std::span<const FingerAxis> others) {
  forget();
  finger_.clear();
  tip_.clear();
  beside_.clear();
  const double scale = bgr.rows / 720.0;
  const double border_v = axis.border_v_px();

  samples_.clear();
  for (double v = border_v - 60 * scale; v < border_v - 4 * scale; v += 4 * scale) {
    const auto row = static_cast<int>(std::lround(v));
    if (row < 0) continue;
    for (double x = -0.8; x < 0.85; x += 0.2) {
      const double u = axis.centre_u(v) + x * axis.half_width(v);
      if (u >= 0 && u <= bgr.cols - 1) samples_.push_back(nearest_pixel(bgr, u, row));
    }
  }
  cluster(samples_, finger_colours, finger_);

  // Close enough to be what the finger would hide if it were wider, far enough not to be its soft edge.
  constexpr std::array<double, 5> beside{1.35, 1.47, 1.6, 1.73, 1.86};
  samples_.clear();
  first_row_ = std::max(0, static_cast<int>(border_v - 80 * scale));
  last_row = std::clamp(last_row, first_row_, bgr.rows - 1);
  for (int row = first_row_; row <= last_row; ++row) {
    for (std::size_t side = 0; side < 2; ++side) {
      Colour sum;
      float n = 0;
      for (const double x : beside) {
        const double u = axis.centre_u(row) + (side == 0 ? -x : x) * axis.half_width(row);
        if (u < 0 || u > bgr.cols - 1) continue;
        const bool finger = std::any_of(others.begin(), others.end(), [&](const FingerAxis& other) {
          return std::abs(u - other.centre_u(row)) < 1.15 * other.half_width(row);
        });
        if (finger) continue;
        const Colour pixel = nearest_pixel(bgr, u, row);
        sum = {sum.b + pixel.b, sum.g + pixel.g, sum.r + pixel.r};
        n += 1;
        const bool on_screen = row > border_v + 3 * scale;
        if (on_screen && row % 4 == 0 && samples_.size() < most_samples) samples_.push_back(pixel);
      }
      row_sides_[static_cast<std::size_t>(row - first_row_)][side] =
          n > 0 ? Colour{sum.b / n, sum.g / n, sum.r / n} : nowhere;
    }
  }
  for (std::size_t row = static_cast<std::size_t>(last_row - first_row_ + 1); row < row_sides_.size(); ++row)
    row_sides_[row] = {nowhere, nowhere};
  cluster(samples_, colours_beside, beside_);
}

void FingerColours::learn_tip(std::span<const Colour> samples, bool guessed) {
  forget();
  tip_guessed_ = guessed;
  samples_.assign(samples.begin(),
                  samples.begin() + static_cast<std::ptrdiff_t>(std::min(samples.size(), most_samples)));
  tip_.clear();
  cluster(samples_, tip_colours, tip_);
}

const FingerColours::Known& FingerColours::looked_up(const Colour& colour) noexcept {
  const auto bits = [](float c) { return static_cast<std::size_t>(std::clamp(c, 0.0F, 255.0F)) >> 3U; };
  Known& known = known_[(bits(colour.b) << 10U) | (bits(colour.g) << 5U) | bits(colour.r)];
  if (known.generation != generation_) {
    known.generation = generation_;
    known.finger2 = std::numeric_limits<float>::max();
    known.beside2 = std::numeric_limits<float>::max();
    for (const Colour& c : finger_)
      known.finger2 = std::min(known.finger2, shaded_distance2(colour, c));
    known.finger_or_tip2 = known.finger2;
    for (const Colour& c : tip_)
      known.finger_or_tip2 = std::min(known.finger_or_tip2, shaded_distance2(colour, c));
    if (!tip_guessed_) known.finger2 = known.finger_or_tip2;
    for (const Colour& c : beside_)
      known.beside2 = std::min(known.beside2, distance2(colour, c));
  }
  return known;
}

float FingerColours::likeness(const Colour& colour, int row) noexcept {
  const Known& known = looked_up(colour);
  const auto index = static_cast<std::size_t>(std::clamp(row - first_row_, 0, static_cast<int>(row_sides_.size()) - 1));
  const auto& sides = row_sides_[index];
  const float beside2 = std::min({known.beside2, distance2(colour, sides[0]), distance2(colour, sides[1])});
  return std::clamp((beside2 - known.finger2) / twice_variance, -limit, limit);
}

}  // namespace telehug
