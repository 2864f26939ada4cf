// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>
#include <optional>

namespace telehug {

enum class Sleeve { none, sleeve, glove };

// Whose hand it is: what stays the same while it moves.
struct HandLooks {
  bool left = false;
  int skin_tone = 2;                // Fitzpatrick 1 (I) to 6 (VI)
  double finger_width_mm = 15;      // of the index finger at its last joint, 12 to 20
  double nail_mm = 0.5;             // how far the nails reach past the finger's end; 12 is very long
  std::optional<cv::Vec3d> polish;  // blue, green, red of the nails, 0 to 255
  bool ring = false;
  Sleeve sleeve = Sleeve::none;
  cv::Vec3d sleeve_tint{120, 80, 60};  // of sleeve or glove

  bool operator==(const HandLooks&) const = default;
};

}  // namespace telehug
