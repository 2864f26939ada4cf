// SPDX-License-Identifier: Apache-2.0
//
// Fingers that approach a screen, touch it or not, and leave, as a rig's camera and a detector with faults see them.
//
// Reaching follows the minimum-jerk profile (Flash, Hogan, J. Neurosci. 1985), and a touch aims behind the screen,
// which stops it; or it follows the power law of the ray-traced samples (h = 90 mm (1 - u)^1.4 down, 80 mm u^1.5 up).
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "calibration/rig_camera.hpp"
#include "touch/camera_foot.hpp"
#include "touch/finger_observation.hpp"

namespace telehug {

inline double minimum_jerk(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}

// Where the finger is `seconds` after the gesture began; z_mm is its height, 0 when it touches.
struct SimulatedGesture {
  std::function<RigVector(double)> at;
  double seconds = 0;
  double width_mm = 15;
};

struct SimulatedSight {
  double frames_per_s = 30;
  double time_jitter_s = 0.002;
  double noise_px = 0.5;
  double width_noise = 0.05;
  double dropouts = 0.01;
  bool mirror = false;
  double wrong_mirror = 0.05;
};

struct SimulatedFrame {
  double seconds = 0;
  std::optional<FingerObservation> seen;
  RigVector truth;
  [[nodiscard]] bool touches() const { return truth.z_mm <= 0; }
};

class SimulatedHand {
 public:
  SimulatedHand(unsigned seed, const RigCamera& camera, const ScreenSize& screen)
      : random_(seed), camera_(camera), screen_(screen) {}

  double between(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }
  double normal(double sd) { return std::normal_distribution(0.0, sd)(random_); }
  bool chance(double share) { return between(0, 1) < share; }

  // A place that the camera sees, its x and y.
  RigVector place() {
    while (true) {
      const RigVector at{between(0.1, 0.9) * screen_.width_mm, between(0.35, 0.95) * screen_.height_mm, 0};
      if (camera_.sees({at.x_mm, at.y_mm})) return at;
    }
  }

  // Approach, contact at `from` for `rest_s`, a stroke to `to` in `stroke_s`, `rest_s` there, release.
  SimulatedGesture touch(const RigVector& from, const RigVector& to, double rest_s, double stroke_s) {
    const double h0 = between(60, 100), down_s = between(0.15, 0.45), up_s = between(0.12, 0.35);
    const double h1 = between(60, 100), depth = between(4, 20), down_power = between(1.1, 1.5),
                 up_power = between(1.3, 1.8);
    const double aside_x = normal(8), aside_y = between(0, 20), away_x = normal(8), away_y = between(0, 20);
    const bool law = chance(0.5);
    // When the hand, aiming `depth` behind the screen, meets it.
    double meets = 1;
    if (!law) {
      for (meets = 0; h0 - (h0 + depth) * minimum_jerk(meets) > 0;)
        meets += 1e-3;
    }
    const double contact_s = 2 * rest_s + stroke_s;
    const auto at = [=](double t) -> RigVector {
      if (t < down_s) {
        const double u = t / down_s;
        const double h = law ? h0 * std::pow(1 - u, down_power) : h0 - (h0 + depth) * minimum_jerk(u * meets);
        const double left = 1 - minimum_jerk(u);
        return {from.x_mm + aside_x * left, from.y_mm + aside_y * left, std::max(h, 1e-3)};
      }
      t -= down_s;
      if (t < contact_s) {
        const double u = stroke_s > 0 ? minimum_jerk((t - rest_s) / stroke_s) : 0;
        return {from.x_mm + u * (to.x_mm - from.x_mm), from.y_mm + u * (to.y_mm - from.y_mm), 0};
      }
      const double u = (t - contact_s) / up_s;
      const double h = h1 * std::pow(u, up_power);
      return {to.x_mm + away_x * u * u, to.y_mm + away_y * u * u, std::max(h, 1e-3)};
    };
    return {at, down_s + contact_s + up_s, between(12, 19)};
  }

  // Comes as near as `height_mm`, waits there for `wait_s`, trembling and drifting, and leaves.
  SimulatedGesture hover(const RigVector& from, const RigVector& to, double height_mm, double wait_s) {
    const double h0 = height_mm + between(50, 80), down_s = between(0.25, 0.6), up_s = between(0.2, 0.4);
    const double sway_mm = between(0.3, 1.5), sway_hz = between(0.4, 1.5), tremor_mm = between(0.05, 0.3),
                 phase = between(0, 6.28);
    const auto at = [=](double t) -> RigVector {
      const double down = minimum_jerk(t / down_s), up = minimum_jerk((t - down_s - wait_s) / up_s);
      const double along = minimum_jerk((t - down_s) / std::max(wait_s, 0.3));
      const double sways = sway_mm * std::sin(6.28 * sway_hz * t + phase) + tremor_mm * std::sin(6.28 * 9 * t);
      // Never nearer than it says.
      const double h = height_mm + sway_mm + tremor_mm + sways + (h0 - height_mm) * (1 - down + up);
      return {from.x_mm + along * (to.x_mm - from.x_mm) + sways, from.y_mm + along * (to.y_mm - from.y_mm), h};
    };
    return {at, down_s + wait_s + up_s, between(12, 19)};
  }

  std::vector<SimulatedFrame> watch(const SimulatedGesture& gesture, const SimulatedSight& sight) {
    std::vector<SimulatedFrame> frames;
    const double width_bias = normal(0.03);
    const double begin = between(0, 1) / sight.frames_per_s;
    for (double t = begin - 3 / sight.frames_per_s; t < gesture.seconds + 5 / sight.frames_per_s;
         t += 1 / sight.frames_per_s) {
      const double seconds = t + between(-sight.time_jitter_s, sight.time_jitter_s);
      SimulatedFrame frame{seconds, std::nullopt, gesture.at(std::clamp(seconds, 0.0, gesture.seconds))};
      if (seconds >= 0 && seconds <= gesture.seconds && !chance(sight.dropouts)) {
        frame.seen = look(frame.truth, gesture.width_mm * std::exp(width_bias), sight);
      }
      frames.push_back(frame);
    }
    return frames;
  }

 private:
  std::optional<FingerObservation> look(const RigVector& tip, double width_mm, const SimulatedSight& sight) {
    const double z0 = camera_.position_mm().z_mm;
    const auto pixel = camera_.project(tip);
    if (tip.z_mm > z0 - 3 || !pixel) return std::nullopt;
    const auto border = camera_.project(ScreenPoint{tip.x_mm, screen_.height_mm});
    const ImageSize image = camera_.image();
    if (!border || pixel->v_px < border->v_px + 5 || pixel->v_px > image.height_px - 1 || pixel->u_px < 0 ||
        pixel->u_px > image.width_px - 1) {
      return std::nullopt;
    }
    const auto at = camera_.screen_point({pixel->u_px + normal(sight.noise_px), pixel->v_px + normal(sight.noise_px)});
    if (!at) return std::nullopt;
    FingerObservation seen;
    seen.screen = *at;
    const double nearer = z0 / (z0 - tip.z_mm);
    // One in fifty widths is far off: the tip barely shows, or a shadow joins it.
    seen.width_mm = width_mm * nearer * std::exp(normal(chance(0.02) ? 0.3 : sight.width_noise));
    const auto beside = camera_.project(ScreenPoint{at->x_mm + 1, at->y_mm});
    if (beside) seen.px_per_mm = std::hypot(beside->u_px - pixel->u_px, beside->v_px - pixel->v_px);
    if (sight.mirror) seen.mirror = mirror(tip.z_mm, sight);
    return seen;
  }

  // Below 1 mm nobody sees a gap, above 30 mm nobody finds the mirror image.
  MirrorEvidence mirror(double height_mm, const SimulatedSight& sight) {
    if (height_mm > 30 || chance(0.1)) return {};
    bool touching = height_mm < 1.5;
    const bool wrong = chance(sight.wrong_mirror);
    if (wrong) touching = !touching;
    const double log_ratio = wrong ? between(0, 2) : between(1, 4);  // as the net is: seldom sure of what is wrong
    return {touching ? MirrorState::touching : MirrorState::hovering, touching ? 0 : height_mm, log_ratio};
  }

  std::mt19937 random_;
  RigCamera camera_;
  ScreenSize screen_;
};

}  // namespace telehug
