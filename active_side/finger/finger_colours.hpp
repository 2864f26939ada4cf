// SPDX-License-Identifier: Apache-2.0
//
// What one finger and its surroundings look like in one frame: no constant of skin colour. A finger's colours are those
// of the strip in front of the border, where the background model knows that it is finger; what is not finger has the
// colours beside it, in the same rows.
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "finger/finger_axis.hpp"

namespace telehug {

struct Colour {
  float b = 0;
  float g = 0;
  float r = 0;
};

[[nodiscard]] inline float distance2(const Colour& x, const Colour& y) noexcept {
  return (x.b - y.b) * (x.b - y.b) + (x.g - y.g) * (x.g - y.g) + (x.r - y.r) * (x.r - y.r);
}

// Between four pixels. The point must lie within the picture, at least one pixel from its right and lower side.
[[nodiscard]] Colour colour_at(const cv::Mat& bgr, float u, float v) noexcept;

class FingerColours {
 public:
  explicit FingerColours(ImageSize largest);

  // From the finger in front of the border, and from beside it down to `last_row`; `others` are fingers that may stand
  // there.
  void learn(const cv::Mat& bgr, const FingerAxis& axis, int last_row, std::span<const FingerAxis> others);
  // Replaces what is known of the fingertip itself (nail, polish, light of the screen). While the tip's outline is only
  // guessed, its colours don't count as finger in likeness(), since they may be the screen's.
  void learn_tip(std::span<const Colour> samples, bool guessed);

  // > 0: finger; < 0: not; between -limit and limit. Colours that are like neither give about 0.
  static constexpr float limit = 1.5F;
  [[nodiscard]] float likeness(const Colour& colour, int row) noexcept;
  // Squared distance from the nearest colour of finger and tip, brightness being free within limits (shading).
  [[nodiscard]] float from_finger2(const Colour& colour) noexcept { return looked_up(colour).finger_or_tip2; }

 private:
  using Palette = boost::container::static_vector<Colour, 8>;
  struct Known {
    std::uint32_t generation = 0;
    float finger2 = 0;
    float finger_or_tip2 = 0;
    float beside2 = 0;
  };

  static void cluster(std::vector<Colour>& samples, std::size_t count, Palette& palette);
  const Known& looked_up(const Colour& colour) noexcept;
  void forget() noexcept;

  Palette finger_;
  Palette tip_;
  bool tip_guessed_ = true;
  Palette beside_;
  int first_row_ = 0;
  std::vector<std::array<Colour, 2>> row_sides_;  // mean colour left and right of the finger
  std::vector<Colour> samples_;
  std::vector<Known> known_;  // by colour, 5 bits a channel: few colours are asked for often
  std::uint32_t generation_ = 0;
};

}  // namespace telehug
