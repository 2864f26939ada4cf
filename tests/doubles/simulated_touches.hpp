// SPDX-License-Identifier: Apache-2.0
//
// Many people at many rigs, each with a few gestures in a row before one contact tracker.
#pragma once

#include "doubles/contact_score.hpp"
#include "doubles/simulated_hand.hpp"

namespace telehug {

enum class Gestures { taps, strokes, hovers, touches_then_a_hover };

// `known_people`: the tracker knows how wide their fingers are, from their calibration's touches.
inline ContactScore simulate_touches(Gestures gestures, const SimulatedSight& sight, unsigned people,
                                     bool known_people = false) {
  constexpr int gestures_each = 4;
  ContactScore score;
  for (unsigned person = 0; person < people; ++person) {
    std::mt19937 random(7 * person + 1);
    const auto between = [&](double least, double most) { return std::uniform_real_distribution(least, most)(random); };
    const ScreenSize screen{between(380, 520), between(255, 320), 0, 0};
    const double x_mm = screen.width_mm / 2 + between(-20, 20);
    const RigCamera camera({between(900, 1080),
                            between(-0.05, 0.05),
                            {x_mm, between(-30, 10), between(38, 60)},
                            between(-2, 2),
                            between(-2, 2),
                            between(-2, 2)},
                           {1280, 720});
    SimulatedHand hand(person, camera, screen);
    SimulatedSight seen = sight;
    seen.noise_px = between(0.3, 1);
    TrackerOptions options;
    options.camera = camera_foot(camera, screen);
    const double width_mm = between(12, 19);
    if (known_people) options.finger_width = {std::log(width_mm), options.filter.known_width};
    ContactTracker tracker(options);
    double start_s = 0;
    for (int i = 0; i < gestures_each; ++i) {
      const RigVector from = hand.place(), to = hand.place();
      const bool hovers =
          gestures == Gestures::hovers || (gestures == Gestures::touches_then_a_hover && i == gestures_each - 1);
      SimulatedGesture gesture;
      if (hovers) {
        const double way = between(0, 1);
        gesture = hand.hover(from, way < 0.3 ? to : from, between(10, 30), way < 0.2 ? 0 : between(0.2, 1));
      } else if (gestures == Gestures::taps) {
        gesture = hand.touch(from, from, between(0.05, 0.08), 0);
      } else {
        const double length_mm = std::hypot(from.x_mm - to.x_mm, from.y_mm - to.y_mm);
        gesture = hand.touch(from, to, between(0, 0.12), std::max(0.25, 1.875 * length_mm / between(200, 1000)));
      }
      gesture.width_mm = width_mm * std::exp(hand.normal(0.05));
      score_gesture(tracker, hand.watch(gesture, seen), start_s, score);
      start_s += gesture.seconds + 1;
    }
  }
  return score;
}

}  // namespace telehug
