// SPDX-License-Identifier: Apache-2.0
#include "bench/touch/drawn_touches.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "calibration/rig_model.hpp"
#include "capture/virtual_rig/random_frame.hpp"
#include "capture/virtual_rig/random_rig.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"
#include "doubles/perfect_calibration.hpp"

namespace telehug {
namespace {

constexpr std::uint64_t rig_seed = 11;
constexpr int pictures = 24;

// Five fingers: two of the left hand, two of the right hand, and one of somebody between them.
std::vector<HandPose> hands(const RandomRig& rig, int fingers, std::uint64_t seed) {
  if (fingers == 1) return random_frame(rig, FrameKind::touch, seed).hands;
  const ScreenSize& screen = rig.settings.screen;
  std::vector<HandPose> all;
  for (const double place : {0.3, 0.5, 0.7}) {
    HandLooks looks = rig.users.front();
    looks.left = place < 0.5;
    const ScreenPoint point{place * screen.width_mm, (0.72 + 0.04 * static_cast<double>(seed % 5)) * screen.height_mm};
    HandPose hand = random_pose(rig.settings, looks, {point, 0}, seed);
    hand.lean_deg = 0;
    if (place != 0.5) hand.second = FingerPlace{{point.x_mm + (looks.left ? -28 : 28), point.y_mm}, 0};
    all.push_back(hand);
  }
  return all;
}

BorderStrip background_of(const BorderCurve& border, ImageSize image, const cv::Mat& empty) {
  const BorderStrip::Layout layout(border, image);
  BorderStrip background(layout);
  background.sample(empty, layout);
  return background;
}

}  // namespace

struct DrawnTouches::Scene {
  explicit Scene(ImageSize image) : rig(random_rig(rig_seed, image)), renderer(rig.settings) {
    renderer.draw(std::vector<HandPose>{}, 0, empty);
  }
  RandomRig rig;
  RigRenderer renderer;
  cv::Mat empty;
};

DrawnTouches::DrawnTouches(ImageSize image, int fingers) : DrawnTouches(Scene(image), image, fingers) {}

DrawnTouches::DrawnTouches(Scene&& scene, ImageSize image, int fingers)
    : empty(scene.empty),
      camera(camera_of(scene.rig.settings)),
      border(camera, scene.rig.settings.screen),
      detector(border, image, background_of(border, image, empty), camera),
      touched{image, scene.rig.settings.screen, RigModel{camera, 5}, {}} {
  const auto wanted = static_cast<std::size_t>(fingers);
  constexpr std::uint64_t most_tries = 200;
  for (std::uint64_t seed = 1; seed < most_tries && touched.pictures.size() < pictures; ++seed) {
    cv::Mat picture;
    scene.renderer.draw(hands(scene.rig, fingers, seed), seed, picture);
    if (detector.detect(picture).size() == wanted) touched.pictures.push_back(std::move(picture));
  }
  if (touched.pictures.size() < pictures) throw std::runtime_error("too few pictures with all fingers in them");
}

}  // namespace telehug
