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
  double tip_radius_mm = 6.6;       // of the ball at the end of a finger 16 mm wide: 5 pointed, 7.8 blunt
  double tip_flatness = 0.86;       // of that ball, from nail to pad: 0.7 flat, 1 round
  double pulp_mm = 0;               // how far the pad bulges out of that ball; 2 is much
  double pulp_side_mm = 0;          // where it does: to the little finger's side of the middle, -3 to 3
  double nail_width = 0.74;         // of the ball's; 0.6 narrow, 0.9 broad
  double nail_mm = 0.5;             // how far the nails reach past the finger's end; 12 is very long
  std::optional<cv::Vec3d> polish;  // blue, green, red of the nails, 0 to 255
  bool ring = false;
  Sleeve sleeve = Sleeve::none;
  cv::Vec3d sleeve_tint{120, 80, 60};  // of sleeve or glove

  bool operator==(const HandLooks&) const = default;
};

}  // namespace telehug
