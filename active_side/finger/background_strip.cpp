// SPDX-License-Identifier: Apache-2.0
#include "finger/background_strip.hpp"

#include <algorithm>
#include <cmath>

#include "common/simd.hpp"

namespace telehug {
namespace {

// Standard deviation of a cell: what a webcam's sensor and JPEG leave, and what light that changes unevenly does.
constexpr float noise_level = 3;
constexpr float uneven_light = 0.06F;
constexpr float like_background = 2;  // distance below which a cell helps to find the gain
constexpr float dark = 3;             // keeps ratios of black cells finite
constexpr int levelling_rounds = 2;
constexpr int part_columns = 32;  // the first gain is the median over parts of so many columns

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
      ratios_(static_cast<std::size_t>(layout.columns / part_columns + 1)) {
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

// Of one value, in standard deviations.
TELEHUG_INLINE float BackgroundStrip::difference_at(const RailView& rail, const Gain& gain, std::size_t channel,
                                                    int i) {
  const float difference = gain[channel] * (rail.now[channel][i] + dark) - (rail.then[channel][i] + dark);
  return difference * rail.inverse_deviation[channel][i];
}

// Of one cell, in variances, summed over the channels.
TELEHUG_INLINE float BackgroundStrip::distance2(const RailView& rail, const Gain& gain, int i) {
  float sum = 0;
  for (std::size_t k = 0; k < gain.size(); ++k) {
    const float difference = difference_at(rail, gain, k, i);
    sum += difference * difference;
  }
  return sum;
}

BackgroundStrip::RailView BackgroundStrip::view(const BorderStrip& strip, int rail) const {
  RailView view{};
  for (int channel = 0; channel < BorderStrip::channels; ++channel) {
    const auto k = static_cast<std::size_t>(channel);
    view.now[k] = strip.row(channel, rail);
    view.then[k] = background_.row(channel, rail);
    view.inverse_deviation[k] =
        inverse_deviation_.data() + static_cast<std::ptrdiff_t>(channel * BorderStrip::rails + rail) * columns_;
  }
  return view;
}

// The median over the rail's parts of how much brighter the background was.
TELEHUG_INLINE BackgroundStrip::Gain BackgroundStrip::first_gain(const RailView& rail) {
  Gain gain;
  for (std::size_t k = 0; k < gain.size(); ++k) {
    auto end = ratios_.begin();
    for (int first = 0; first < columns_; first += part_columns) {
      float then = 0;
      float now = 0;
      for (int i = first; i < std::min(first + part_columns, columns_); ++i) {
        then += rail.then[k][i] + dark;
        now += rail.now[k][i] + dark;
      }
      *end++ = then / now;
    }
    const auto middle = ratios_.begin() + (end - ratios_.begin()) / 2;
    std::nth_element(ratios_.begin(), middle, end);
    gain[k] = *middle;
  }
  return gain;
}

// From the cells that look like background with the gain so far.
TELEHUG_INLINE BackgroundStrip::Gain BackgroundStrip::better_gain(const RailView& rail, const Gain& gain) const {
  constexpr float limit = like_background * like_background * BorderStrip::channels;
  Gain now{};
  Gain then{};
  float alike_cells = 0;
  for (int i = 0; i < columns_; ++i) {
    const float alike = distance2(rail, gain, i) < limit ? 1.0F : 0.0F;
    for (std::size_t k = 0; k < gain.size(); ++k) {
      now[k] += alike * (rail.now[k][i] + dark);
      then[k] += alike * (rail.then[k][i] + dark);
    }
    alike_cells += alike;
  }
  if (alike_cells <= 0.1F * static_cast<float>(columns_)) return gain;
  return {then[0] / now[0], then[1] / now[1], then[2] / now[2]};
}

TELEHUG_SIMD const std::vector<float>& BackgroundStrip::distance(const BorderStrip& strip) {
  float alike = 0;
  for (int r = 0; r < BorderStrip::rails; ++r) {
    const RailView rail = view(strip, r);
    Gain gain = first_gain(rail);
    for (int round = 0; round < levelling_rounds; ++round)
      gain = better_gain(rail, gain);
    gain_[static_cast<std::size_t>(r)] = gain;
    const auto start = static_cast<std::ptrdiff_t>(r) * columns_;
    float* const distance = distance_.data() + start;
    for (int i = 0; i < columns_; ++i) {
      const float d = std::min(std::sqrt(distance2(rail, gain, i) / BorderStrip::channels), far);
      distance[i] = d;
      alike += d < like_background ? 1.0F : 0.0F;
    }
  }
  unchanged_share_ = static_cast<double>(alike) / static_cast<double>(distance_.size());
  return distance_;
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
