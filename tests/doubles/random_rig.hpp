// SPDX-License-Identifier: Apache-2.0
//
// Rigs of all kinds with their exact observations, for the tests of the default touch model.
#pragma once

#include <array>
#include <optional>
#include <random>

#include "calibration/rig_residuals.hpp"
#include "calibration/rig_solver.hpp"

namespace telehug {

struct KnownRig {
  ScreenSize screen;
  RigModel model;

  [[nodiscard]] ImagePoint tip(const ScreenPoint& contact) const {
    return tip_of_contact(model.camera, model.contact_radius_mm, contact).value();
  }
  [[nodiscard]] bool sees_tip(const ScreenPoint& contact) const {
    const auto at = tip_of_contact(model.camera, model.contact_radius_mm, contact);
    const ImageSize image = model.camera.image();
    return at && at->u_px >= 0 && at->u_px <= image.width_px - 1 && at->v_px >= 0 && at->v_px <= image.height_px - 1;
  }
};

class RandomRigs {
 public:
  explicit RandomRigs(unsigned seed) : random_(seed) {}

  double between(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }
  double normal(double sd) { return std::normal_distribution(0.0, sd)(random_); }

  // Within the priors' range, with the screen's bottom edge in the picture: camera above and below the screen's upper
  // edge, up to 4 degrees off, lenses of both signs.
  KnownRig rig(PictureOrientation orientation = {}) {
    while (true) {
      const KnownRig rig = any_rig(orientation);
      if (places(rig, 9).size() == 9) return rig;
    }
  }

  // The same with every parameter drawn from the solver's own priors.
  KnownRig usual_rig() {
    const ImageSize image{1280, 720};
    while (true) {
      const ScreenSize screen{between(340, 520), between(220, 340), 0, 0};
      const RigPriors priors = usual_rigs(screen, image);
      RigParameters parameters{};
      for (std::size_t i = 0; i < parameters.size(); ++i)
        parameters[i] = priors.mean[i] + normal(priors.sd[i]);
      if (parameters[RigParameter::z0_mm] < 15 || parameters[RigParameter::focal_px] < 500) continue;
      const KnownRig rig{screen, make_rig_model(parameters, image, {})};
      if (places(rig, 9).size() == 9) return rig;
    }
  }

  // `count` places that the camera sees, spread over what it sees of the screen; fewer if it sees little.
  std::vector<ScreenPoint> places(const KnownRig& rig, std::size_t count) {
    constexpr std::array<ScreenPoint, 9> spread{
        ScreenPoint{0.5, 0.6}, {0.6, 0.85}, {0.05, 0.95}, {0.95, 0.95}, {0.5, 0.4}, {0.2, 0.7}, {0.8, 0.7},
        {0.35, 0.85},          {0.65, 0.5}};
    std::vector<ScreenPoint> found;
    for (std::size_t i = 0; i < count; ++i) {
      ScreenPoint place{spread[i].x_mm * rig.screen.width_mm, spread[i].y_mm * rig.screen.height_mm};
      const ScreenPoint middle{0.5 * rig.screen.width_mm, 0.9 * rig.screen.height_mm};
      for (int nearer = 0; nearer < 12 && !rig.sees_tip(place); ++nearer)
        place = {place.x_mm + 0.15 * (middle.x_mm - place.x_mm), place.y_mm + 0.15 * (middle.y_mm - place.y_mm)};
      if (rig.sees_tip(place)) found.push_back(place);
    }
    return found;
  }

  RigObservations observe(const KnownRig& rig, std::size_t touches, double noise_px, double sigma_px,
                          bool with_border = true) {
    RigObservations seen{rig.screen, rig.model.camera.image(), {}, {}, {}};
    const auto blurred = [&](const ImagePoint& p) {
      return ImagePoint{p.u_px + normal(noise_px), p.v_px + normal(noise_px)};
    };
    for (const ScreenPoint& place : places(rig, touches))
      seen.touches.push_back({place, blurred(rig.tip(place)), sigma_px, sigma_px});
    for (int i = 0; with_border && i < 16; ++i) {
      const double u = (i + 0.5) / 16 * seen.image.width_px;
      const auto v = border_row(rig.model.camera, rig.screen.height_mm, u);
      if (v) seen.border.push_back({{u, *v + normal(noise_px)}, sigma_px});
    }
    return seen;
  }

 private:
  KnownRig any_rig(PictureOrientation orientation) {
    constexpr std::array<ImageSize, 4> images{ImageSize{640, 480}, {1280, 720}, {1920, 1080}, {1280, 960}};
    const ImageSize image = images[static_cast<std::size_t>(between(0, 3.999))];
    const ScreenSize screen{between(280, 620), between(180, 380), 0, 0};
    const double scale = image.width_px / 1280.0;
    return {screen,
            {RigCamera({between(700, 1300) * scale,
                        between(-0.08, 0.08),
                        {0.5 * screen.width_mm + between(-40, 40), between(-45, 25), between(25, 90)},
                        between(-4, 4),
                        between(-4, 4),
                        between(-4, 4)},
                       image, orientation),
             between(4, 25)}};
  }

  std::mt19937 random_;
};

}  // namespace telehug
