// SPDX-License-Identifier: Apache-2.0
//
// How the border strip looks when nobody reaches across it, and what differs from that in a frame.
//
// Cameras change exposure and white balance from frame to frame, screens light up the bezel: every rail of a frame is
// first brought to the background's level by one gain a channel, taken from the cells that look like background.
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "finger/border_strip.hpp"

namespace telehug {

class BackgroundStrip {
 public:
  // `empty` is what the strip looks like with nobody there.
  BackgroundStrip(const BorderStrip::Layout& layout, const BorderStrip& empty);

  // How far each cell is from the background, in standard deviations of the noise, cut off at `far`; rails by columns.
  // Valid until the next call. Allocates nothing.
  static constexpr float far = 6;
  const std::vector<float>& distance(const BorderStrip& strip);

  // The share of cells that looked like background in the last distance(): near 0 when the light was switched or the
  // camera was moved.
  [[nodiscard]] double unchanged_share() const noexcept { return unchanged_share_; }

  // Learns from the last strip given to distance(): cells that look like background soon, others (a cup that was put
  // there) slowly, those under fingers - `is_finger`, one flag a column, or all if the scene is disturbed - hardly.
  void adapt(const BorderStrip& strip, const std::vector<bool>& is_finger);

  // From now on `empty` is what the strip looks like with nobody there. Allocates nothing.
  void set(const BorderStrip& empty);

 private:
  using Gain = std::array<float, BorderStrip::channels>;
  using Channels = std::array<const float*, BorderStrip::channels>;
  // One rail of the frame and of the background.
  struct RailView {
    Channels now;
    Channels then;
    Channels inverse_deviation;
  };

  void set_background(int rail);
  [[nodiscard]] RailView view(const BorderStrip& strip, int rail) const;
  [[nodiscard]] static float difference_at(const RailView& rail, const Gain& gain, std::size_t channel, int column);
  [[nodiscard]] static float distance2(const RailView& rail, const Gain& gain, int column);
  [[nodiscard]] Gain first_gain(const RailView& rail);
  [[nodiscard]] Gain better_gain(const RailView& rail, const Gain& gain) const;

  int columns_;
  BorderStrip background_;
  std::vector<float> inverse_deviation_;  // of each value
  std::vector<float> distance_;
  std::array<Gain, BorderStrip::rails> gain_{};  // background = gain * frame
  std::vector<float> ratios_;                    // of parts of a rail
  double unchanged_share_ = 1;
};

}  // namespace telehug
