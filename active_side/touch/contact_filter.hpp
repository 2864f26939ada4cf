// SPDX-License-Identifier: Apache-2.0
//
// Does this finger touch? A hidden Markov model with three states, updated with every frame:
//
//   moving    in the air, on the way to or from the screen
//   hovering  in the air, more or less at rest
//   touching  on the screen, at rest or sliding
//
// What tells them apart, strongest first:
//   - the mirror image, where the screen shows one;
//   - motion: seen from the camera, a change of height moves the finger along the line through the camera's foot, by
//     d log r = dh / (z0 - h), tens of millimetres a frame. Contact ends that within a frame, a hand that stops in the
//     air needs several. Lifting starts it from nothing, which no stroke along the screen does;
//   - the width, which changes by the same factor as r if the height changes, and not on a slide;
//   - the width itself, against that of a finger which surely touched: at 10 mm it is 25 to 30 % too large.
#pragma once

#include <array>
#include <optional>

#include "touch/camera_foot.hpp"
#include "touch/finger_observation.hpp"

namespace telehug {

struct ContactFilterOptions {
  double tip_noise_px = 0.7;  // standard deviation of a tip of quality 1
  // What one picture's mirror image counts at most; less where a finger is first seen, which may be a flash.
  double most_mirror_log_ratio = 4;
  double first_mirror_log_ratio = 2.3;
  double width_noise = 0.07;  // relative standard deviation of a measured width, from frame to frame
  double known_width = 0.08;  // of the fingers of people who have touched
  // Hands: a touch meets the screen faster than this, a hand that comes to rest in the air is slower in the end.
  double impact_mm_s = 60;
  double lift_mm_s = 150;     // mean speed of a finger in the first frame after it left the screen
  double drift_mm_s = 6;      // of a hand that nothing supports, in height
  double air_mm_s2 = 5000;    // acceleration of a hand in the air
  double slide_mm_s2 = 6000;  // and along the screen: a stroke of 200 mm in 0.35 s reaches 1 m/s with 9 m/s2
  double across_mm_s = 60;    // speed along the screen while it lands or is lifted
  double slide_mm_s = 100;    // of a stroke that begins
  // How often these happen, a second.
  double land_rate = 4;
  double halt_rate = 2.5;  // a moving hand stops in the air
  double lift_rate = 4;
  double dropout = 0.01;  // share of frames in which a finger that is there is not found
};

// How wide fingers are: natural logarithm of mm and its standard deviation. Of people nobody has seen: 15 mm, 15 %.
struct FingerWidth {
  double log_mm = 2.708;
  double sd = 0.15;
};

class ContactFilter {
 public:
  // `seconds_unseen`: since the last frame, in which this finger was not there; nothing: unknown.
  ContactFilter(const CameraFoot& camera, const ContactFilterOptions& options, const FingerWidth& known,
                const FingerObservation& first, std::optional<double> seconds_unseen);

  // The same finger in a later frame, `seconds` > 0 after it was last seen.
  void update(const FingerObservation& finger, double seconds, const FingerWidth& known);

  // The same finger in a frame that tells nothing but its place; the next frame can't be compared with this one.
  void skip(const FingerObservation& finger);

  // The finger is not seen, for the n-th frame in a row, `seconds` after it was: the probability that it still touches.
  // Lifted a little, a finger near the bottom edge does not reach over the border any more.
  [[nodiscard]] double touching_unseen(int frames, double seconds) const;

  [[nodiscard]] double touching() const noexcept { return probability_[touching_state]; }
  [[nodiscard]] bool moving() const noexcept { return belief_[moving_state] > 0.5; }

  // Its width, as measured since it came to rest or touched (log mm), if it was.
  [[nodiscard]] std::optional<double> width() const noexcept;

 private:
  static constexpr std::size_t moving_state = 0;
  static constexpr std::size_t hovering_state = 1;
  static constexpr std::size_t touching_state = 2;
  using States = std::array<double, 3>;

  struct Step {
    double seconds = 0;
    double log_r = 0;  // change of log r
    double radial_mm = 0;
    double across_mm = 0;
    double noise_radial_mm = 0;
    double noise_across_mm = 0;
    std::optional<double> width;  // change of log width
  };

  [[nodiscard]] Step step_to(const FingerObservation& finger, double seconds) const;
  [[nodiscard]] std::array<States, 3> transitions(const Step& step) const;
  [[nodiscard]] double rests_or_slides(const Step& step, double extra_radial_mm) const;
  [[nodiscard]] double noise_mm(const FingerObservation& finger) const;
  bool came_over_border(double seconds);
  void weigh_mirror(const MirrorEvidence& mirror, double most_log_ratio);
  void weigh_width(const FingerObservation& finger, const FingerWidth& known);
  void remember(const FingerObservation& finger);

  CameraFoot camera_;
  ContactFilterOptions options_;
  FingerObservation last_;
  double radius_mm_ = 0;  // of the last place, from the camera's foot
  bool comparable_ = true;
  std::optional<double> log_r_speed_;  // of the last step, 1/s; nothing: unknown
  double radial_mm_s_ = 0;
  double across_mm_s_ = 0;
  States belief_{};       // from motion and mirror
  States probability_{};  // with the width
  double width_sum_ = 0;
  int widths_ = 0;
};

}  // namespace telehug
