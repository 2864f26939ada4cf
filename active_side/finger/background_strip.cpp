// SPDX-License-Identifier: Apache-2.0
#include "finger/background_strip.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

// Standard deviation of a cell: what a webcam's sensor and JPEG leave, and what light that changes unevenly does.
constexpr float noise_level = 3;
constexpr float uneven_light = 0.06F;
constexpr float like_background = 2;  // distance below which a cell helps to find the gain
constexpr float dark = 3;             // keeps ratios of black cells finite
constexpr int levelling_rounds = 3;
constexpr int median_step = 4;  // every how many cells the first gain looks at

// Shares of the way to the present frame, at 30 frames a second: half a second, 20 seconds, 2 minutes.
constexpr float learn_background = 1.0F / 15;
constexpr float learn_thing = 1.0F / 600;
constexpr float learn_finger = 1.0F / 3600;

}  // namespace

BackgroundStrip::BackgroundStrip(const BorderStrip::Layout& layout, const BorderStrip& empty)
    : columns_(layout.columns),
      background_(empty),
      inverse_deviation_(layout.cells() * BorderStrip::channels),
      distance_(layout.cells()),
      difference_(layout.cells() * BorderStrip::channels),
      new_edges_(layout.cells()),
      scratch_(static_cast<std::size_t>(layout.columns)) {
  for (int rail = 0; rail < BorderStrip::rails; ++rail)
    set_background(rail);
}

void BackgroundStrip::set_background(int rail) {
  for (int channel = 0; channel < BorderStrip::channels; ++channel) {
    const float* const level = background_.row(channel, rail);
    float* const inverse =
        inverse_deviation_.data() + static_cast<std::ptrdiff_t>(channel * BorderStrip::rails + rail) * columns_;
    for (int i = 0; i < columns_; ++i) {
      inverse[i] = 1.0F / std::sqrt(noise_level * noise_level + uneven_light * uneven_light * level[i] * level[i]);
    }
  }
}

void BackgroundStrip::level(const BorderStrip& strip, int rail) {
  auto& gain = gain_[static_cast<std::size_t>(rail)];
  std::size_t n = 0;
  for (int i = 0; i < columns_; i += median_step) {
    float now = dark;
    float then = dark;
    for (int channel = 0; channel < BorderStrip::channels; ++channel) {
      now += strip.row(channel, rail)[i];
      then += background_.row(channel, rail)[i];
    }
    scratch_[n++] = then / now;
  }
  const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(scratch_.begin(), middle, scratch_.begin() + static_cast<std::ptrdiff_t>(n));
  gain.fill(*middle);

  float* const distance = distance_.data() + static_cast<std::ptrdiff_t>(rail) * columns_;
  for (int round = 0; round < levelling_rounds; ++round) {
    std::fill_n(distance, columns_, 0.0F);
    for (int channel = 0; channel < BorderStrip::channels; ++channel) {
      const float g = gain[static_cast<std::size_t>(channel)];
      const float* const now = strip.row(channel, rail);
      const float* const then = background_.row(channel, rail);
      const auto start = static_cast<std::ptrdiff_t>(channel * BorderStrip::rails + rail) * columns_;
      const float* const inverse = inverse_deviation_.data() + start;
      float* const difference = difference_.data() + start;
      for (int i = 0; i < columns_; ++i) {
        difference[i] = (g * (now[i] + dark) - (then[i] + dark)) * inverse[i];
        distance[i] += difference[i] * difference[i];
      }
    }
    constexpr float limit = like_background * like_background * BorderStrip::channels;
    if (round + 1 == levelling_rounds) break;
    for (int channel = 0; channel < BorderStrip::channels; ++channel) {
      const float* const now = strip.row(channel, rail);
      const float* const then = background_.row(channel, rail);
      float sum_now = 0;
      float sum_then = 0;
      float cells = 0;
      for (int i = 0; i < columns_; ++i) {
        const float alike = distance[i] < limit ? 1.0F : 0.0F;
        sum_now += alike * (now[i] + dark);
        sum_then += alike * (then[i] + dark);
        cells += alike;
      }
      if (cells > 0.1F * static_cast<float>(columns_)) gain[static_cast<std::size_t>(channel)] = sum_then / sum_now;
    }
  }
}

const std::vector<float>& BackgroundStrip::distance(const BorderStrip& strip) {
  for (int rail = 0; rail < BorderStrip::rails; ++rail)
    level(strip, rail);
  std::size_t alike = 0;
  for (float& d : distance_) {
    d = std::min(std::sqrt(d / BorderStrip::channels), far);
    alike += d < like_background ? 1 : 0;
  }
  unchanged_share_ = static_cast<double>(alike) / static_cast<double>(distance_.size());
  return distance_;
}

const std::vector<float>& BackgroundStrip::new_edges() {
  std::fill(new_edges_.begin(), new_edges_.end(), 0.0F);
  const auto plane = static_cast<std::ptrdiff_t>(distance_.size());
  for (int channel = 0; channel < BorderStrip::channels; ++channel) {
    const float* const difference = difference_.data() + channel * plane;
    for (std::ptrdiff_t i = 1; i + 1 < plane; ++i) {
      const float step = difference[i + 1] - difference[i - 1];
      new_edges_[static_cast<std::size_t>(i)] += step * step;
    }
  }
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    float* const edge = new_edges_.data() + static_cast<std::ptrdiff_t>(rail) * columns_;
    edge[0] = edge[columns_ - 1] = 0;  // their neighbours lie on other rails
    for (int i = 0; i < columns_; ++i)
      edge[i] = std::min(std::sqrt(edge[i] / BorderStrip::channels), far);
  }
  return new_edges_;
}

void BackgroundStrip::adapt(const BorderStrip& strip, const std::vector<bool>& is_finger) {
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    const float* const distance = distance_.data() + static_cast<std::ptrdiff_t>(rail) * columns_;
    for (int channel = 0; channel < BorderStrip::channels; ++channel) {
      const float g = gain_[static_cast<std::size_t>(rail)][static_cast<std::size_t>(channel)];
      const float* const now = strip.row(channel, rail);
      float* const then = background_.row(channel, rail);
      for (int i = 0; i < columns_; ++i) {
        const float share = is_finger[static_cast<std::size_t>(i)] ? learn_finger
                            : distance[i] < like_background        ? learn_background
                                                                   : learn_thing;
        then[i] += share * (g * (now[i] + dark) - dark - then[i]);
      }
    }
    set_background(rail);
  }
}

void BackgroundStrip::set(const BorderStrip& empty) {
  background_ = empty;
  for (int rail = 0; rail < BorderStrip::rails; ++rail)
    set_background(rail);
}

}  // namespace telehug
