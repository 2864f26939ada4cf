// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_dot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "calibration/dot_edges.hpp"
#include "calibration/dot_outline.hpp"
#include "calibration/rig_observations.hpp"
#include "calibration/rig_solver.hpp"
#include "calibration/whiteness.hpp"

namespace telehug {
namespace {

// Fainter than this many grey levels above the screen nothing is a dot.
constexpr float least_contrast = 30;

// A camera that the outline is tried with. Its distance from the screen makes the dot's width, its pitch the height.
struct Guess {
  ImagePoint centre;
  double z0_mm = 0;
  double pitch_deg = 0;
  double score = -1;
};

class DotSearch {
 public:
  DotSearch(const Whiteness& white, ImageSize image, const BorderLine& border, double diameter_mm)
      : white_(white), image_(image), border_(border), diameter_mm_(diameter_mm), scale_(picture_scale(image)) {
    const RigPriors priors = usual_rigs({400, 300, 0, 0}, image);
    parameters_ = priors.mean;
    parameters_[RigParameter::roll_deg] = std::atan(border.slope) * 180 / std::numbers::pi;
  }

  // The places where the outline lies well on steps from white to black, the best first.
  [[nodiscard]] std::vector<Guess> guesses() const {
    std::vector<Guess> guesses;
    for (const double z0_mm : {24.0, 30.0, 37.0, 46.0, 57.0, 71.0, 88.0}) {
      Guess best_here;
      scan(z0_mm, best_here);
      if (best_here.score > 0) guesses.push_back(best_here);
    }
    for (Guess& guess : guesses)
      climb(guess);
    std::sort(guesses.begin(), guesses.end(), [](const Guess& a, const Guess& b) { return a.score > b.score; });
    return guesses;
  }

  [[nodiscard]] RigCamera camera(const Guess& guess) const {
    RigParameters parameters = parameters_;
    parameters[RigParameter::z0_mm] = guess.z0_mm;
    parameters[RigParameter::pitch_deg] = guess.pitch_deg;
    return make_rig_model(parameters, image_, {}).camera;
  }

 private:
  [[nodiscard]] double score(const RigCamera& camera, const ImagePoint& centre) const {
    const auto outline = dot_outline(camera, centre, diameter_mm_);
    if (!outline) return -1;
    const double reach = 1.5 * scale_;
    double sum = 0, weights = 0;
    for (const DotOutline::Point& point : outline->points) {
      if (!DotOutline::is_visible(point)) continue;
      // At the ends nothing hides the dot.
      const double weight = 1 + 1.5 * std::abs(point.cosine * point.cosine * point.cosine);
      sum += weight * std::clamp((white_.at(point.along(-reach)) - white_.at(point.along(reach))) / white_.contrast(),
                                 -0.3F, 0.6F);
      weights += weight;
    }
    return sum / weights;
  }

  void scan(double z0_mm, Guess& best) const {
    const RigCamera camera = this->camera({{}, z0_mm, 0, 0});
    const double step_v = 2 * scale_;
    const double step_u = 4 * scale_;
    for (double v = white_.top_px(); v < image_.height_px; v += step_v) {
      for (double u = 0; u < image_.width_px; u += step_u) {
        if (v < border_.v_at(u) || !white_.is_white({u, v + step_v})) continue;
        const double here = score(camera, {u, v});
        if (here > best.score) best = {{u, v}, z0_mm, 0, here};
      }
    }
  }

  // Directions of place, width and height; the last two move the outline's upper edge alone.
  static constexpr std::array<std::array<double, 4>, 10> climbs{{{1, 0, 0, 0},
                                                                 {-1, 0, 0, 0},
                                                                 {0, 1, 0, 0},
                                                                 {0, -1, 0, 0},
                                                                 {0, 0, 1, 0},
                                                                 {0, 0, -1, 0},
                                                                 {0, 0, 0, 1},
                                                                 {0, 0, 0, -1},
                                                                 {0, 1, 0, 1},
                                                                 {0, -1, 0, -1}}};

  // Uphill in small and smaller steps of place, width and height.
  void climb(Guess& guess) const {
    for (double step = 2; step > 0.2; step /= 2) {
      for (bool better = true; better;) {
        better = false;
        for (const auto& [du, dv, dz, dp] : climbs) {
          Guess next = guess;
          next.centre.u_px += du * step * scale_;
          next.centre.v_px += dv * step * scale_;
          next.z0_mm *= 1 + 0.04 * dz * step;
          next.pitch_deg = std::clamp(next.pitch_deg + dp * step, -4.0, 4.0);
          next.score = score(camera(next), next.centre);
          if (next.score > guess.score + 1e-4) guess = next, better = true;
        }
      }
    }
  }

  const Whiteness& white_;
  ImageSize image_;
  BorderLine border_;
  double diameter_mm_;
  double scale_;
  RigParameters parameters_{};
};

void check(const cv::Mat& bgr) {
  if (bgr.type() != CV_8UC3 || bgr.empty()) throw std::invalid_argument("calibration dot: the picture must be CV_8UC3");
}

}  // namespace

std::optional<CalibrationDot> find_calibration_dot(const cv::Mat& bgr, const BorderLine& border, double diameter_mm) {
  check(bgr);
  const ImageSize image{bgr.cols, bgr.rows};
  const int top = static_cast<int>(std::floor(std::min(border.v_at(0), border.v_at(bgr.cols))));
  const Whiteness white(bgr, {0, top, bgr.cols, bgr.rows - top});
  if (white.contrast() < least_contrast) return std::nullopt;
  const DotSearch search(white, image, border, diameter_mm);
  for (const Guess& guess : search.guesses()) {
    if (const auto dot = fit_dot_edges(bgr, search.camera(guess), guess.centre, diameter_mm)) return dot;
  }
  return std::nullopt;
}

std::optional<CalibrationDot> refine_calibration_dot(const cv::Mat& bgr, const RigCamera& camera,
                                                     const ImagePoint& near, double diameter_mm) {
  check(bgr);
  return fit_dot_edges(bgr, camera, near, diameter_mm);
}

}  // namespace telehug
