// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/random_rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "capture/virtual_rig/random_numbers.hpp"

namespace telehug {
namespace {

constexpr std::uint64_t golden = 0x9E3779B97F4A7C15ULL;

Tint grey(RandomNumbers& random, double low, double high) {
  const double level = random.uniform(low, high);
  return {level * random.uniform(0.95, 1.05), level, level * random.uniform(0.95, 1.05)};
}

// Of cloth, plastic and paint: seldom as pure as it could be.
Tint any_colour(RandomNumbers& random) {
  const double grey_level = random.uniform(30, 200);
  const double purity = random.uniform(0.1, 0.8);
  const auto mixed = [&] { return grey_level + purity * (random.uniform(20, 220) - grey_level); };
  const double blue = mixed();
  const double green = mixed();
  return {blue, green, mixed()};
}

void draw_screen(RandomNumbers& random, VirtualRigSettings& s) {
  struct Shape {
    double ratio;
    int width_px;
    int height_px;
  };
  static constexpr std::array<Shape, 6> shapes{{{1.25, 1280, 1024},
                                                {1.6, 1440, 900},
                                                {1.6, 1920, 1200},
                                                {16.0 / 9, 1920, 1080},
                                                {16.0 / 9, 1366, 768},
                                                {21.0 / 9, 2560, 1080}}};
  const Shape& shape = random.one_of(shapes);
  // 190 to 350 mm high: a webcam on top of a higher screen sees its lower border at too flat an angle.
  const double narrowest = std::max(300.0, 190 * shape.ratio);
  const double widest = std::min(700.0, 350 * shape.ratio);
  s.screen.width_mm = std::round(random.uniform(narrowest, widest));
  s.screen.height_mm = std::round(s.screen.width_mm / shape.ratio);
  s.screen.width_px = shape.width_px;
  s.screen.height_px = shape.height_px;
}

std::string draw_bezel(RandomNumbers& random, VirtualRigSettings& s) {
  s.bezel_mm = random.uniform(5, 30);
  s.bezel_raised_mm = random.uniform(0.5, 6);
  const double kind = random.uniform(0, 1);
  if (kind < 0.45) {
    s.bezel_tint = grey(random, 20, 60);
    return "black";
  }
  if (kind < 0.7) {
    s.bezel_tint = grey(random, 145, 195);
    return "silver";
  }
  if (kind < 0.9) {
    s.bezel_tint = grey(random, 215, 245);
    return "white";
  }
  s.bezel_tint = any_colour(random);
  return "coloured";
}

std::string draw_coat(RandomNumbers& random, ScreenCoat& coat) {
  coat.haze = random.uniform(0.002, 0.012);
  const double kind = random.uniform(0, 1);
  if (kind < 0.35) {
    coat.mirror = random.uniform(0.6, 1);
    coat.roughness_deg = random.uniform(0.02, 0.3);
    return "glossy";
  }
  if (kind < 0.65) {
    coat.mirror = random.uniform(0.4, 0.8);
    coat.roughness_deg = random.uniform(0.6, 2);
    return "satin";
  }
  coat.mirror = random.uniform(0.3, 0.7);
  coat.roughness_deg = random.uniform(2.5, 6);
  return "matt";
}

std::string draw_light(RandomNumbers& random, VirtualRigSettings& s) {
  s.light.level = random.uniform(0.6, 1.1);
  s.light.directed = random.uniform(0.15, 0.4);
  s.light.towards = {random.uniform(-0.4, 0.4), -1, random.uniform(0.1, 0.8)};
  s.noise_sd = random.uniform(1.5, 4.5);
  static constexpr std::array<const char*, 5> kinds{"neutral", "warm", "cold", "side", "dim"};
  const std::size_t kind = random.index(kinds.size());
  switch (kind) {
    case 1:
      s.light.colour = {random.uniform(0.62, 0.85), random.uniform(0.86, 0.95), 1.08};
      break;
    case 2:
      s.light.colour = {1.12, 1.0, random.uniform(0.78, 0.9)};
      break;
    case 3:
      s.light.directed = random.uniform(0.45, 0.7);
      s.light.towards = {random.chance(0.5) ? 1.0 : -1.0, random.uniform(-0.9, -0.4), random.uniform(0, 0.6)};
      break;
    case 4:
      s.light.level = random.uniform(0.12, 0.3);
      s.noise_sd = random.uniform(4, 8);
      break;
    default:
      break;
  }
  return kinds[kind];
}

std::string draw_desk(RandomNumbers& random, VirtualRigSettings& s) {
  DeskLooks& desk = s.desk;
  desk.seed = static_cast<std::uint64_t>(random.uniform(1, 1e9));
  s.desk_below_mm = random.uniform(40, 160);
  desk.foot_half_width_mm = random.chance(0.75) ? random.uniform(60, 150) : 0;
  desk.foot_front_mm = random.uniform(40, 130);
  desk.foot_tint = random.chance(0.5) ? grey(random, 30, 70) : grey(random, 100, 220);
  desk.keyboard = random.chance(0.4);
  desk.cup = random.chance(0.3);
  const double kind = random.uniform(0, 1);
  if (kind < 0.35) {
    static const std::array<Tint, 5> woods{
        Tint{60, 105, 165}, {95, 140, 190}, {40, 66, 104}, {120, 165, 205}, {70, 85, 120}};
    desk.kind = DeskKind::wood;
    desk.tint = random.one_of(woods) * random.uniform(0.85, 1.1);
    return "wood";
  }
  if (kind < 0.5) {
    desk.kind = DeskKind::stone;
    desk.tint = grey(random, 70, 200);
    return "stone";
  }
  desk.kind = DeskKind::plain;
  desk.tint = kind < 0.75 ? grey(random, 170, 240) : kind < 0.92 ? grey(random, 20, 80) : any_colour(random);
  return "plain";
}

// A pixel row at the lower border is at most 2.5 mm high (facts of a pinhole: (H - y0)^2 / (f z0)).
void draw_camera(RandomNumbers& random, VirtualRigSettings& s) {
  const double scale = s.image.width_px / 1280.0;
  for (;;) {
    const double focal_px = random.uniform(800, 1150);
    const double above_mm = random.uniform(4, 28);
    const double reach_mm = s.screen.height_mm + above_mm;
    const double nearest_mm = std::max(25.0, reach_mm * reach_mm / (2.5 * focal_px));
    if (nearest_mm > 80) continue;
    s.focal_px = focal_px * scale;
    s.distortion_k1 = random.uniform(-0.08, 0.08);
    s.camera.position_mm = {s.screen.width_mm / 2 + random.uniform(-30, 30), -above_mm, random.uniform(nearest_mm, 80)};
    s.camera.pitch_deg = random.uniform(-4, 4);
    s.camera.yaw_deg = random.uniform(-4, 4);
    s.camera.roll_deg = random.uniform(-4, 4);
    const PinholeCamera camera(s.camera, s.focal_px, s.image, s.distortion_k1);
    const double border = camera.project({s.screen.width_mm / 2, s.screen.height_mm, 0}).v_px / s.image.height_px;
    if (border > 0.35 && border < 0.85) return;
  }
}

}  // namespace

RandomRig rig_of(const VirtualRigSettings& settings) {
  RandomRig rig;
  rig.settings = settings;
  rig.users = {settings.hand};
  rig.contents = {settings.content};
  rig.random_poses = false;
  return rig;
}

HandLooks random_looks(std::uint64_t seed) {
  RandomNumbers random(seed * golden + 5);
  HandLooks looks;
  looks.left = random.chance(0.4);
  looks.skin_tone = 1 + static_cast<int>(random.index(6));
  looks.finger_width_mm = random.uniform(12, 20);
  looks.nail_mm = random.chance(0.7) ? random.uniform(0, 1.5) : random.uniform(5, 12);
  if (random.chance(0.3)) looks.polish = any_colour(random);
  looks.ring = random.chance(0.2);
  const double sleeve = random.uniform(0, 1);
  if (sleeve < 0.2) looks.sleeve = Sleeve::sleeve;
  if (sleeve > 0.97) looks.sleeve = Sleeve::glove;
  looks.sleeve_tint = any_colour(random);
  return looks;
}

RandomRig random_rig(std::uint64_t seed, ImageSize image) {
  RandomNumbers random(seed * golden + 1);
  RandomRig rig;
  VirtualRigSettings& s = rig.settings;
  s.image = image;
  s.seed = seed;
  draw_screen(random, s);
  draw_camera(random, s);
  rig.group.bezel = draw_bezel(random, s);
  rig.group.coat = draw_coat(random, s.coat);
  rig.group.light = draw_light(random, s);
  rig.group.desk = draw_desk(random, s);
  s.screen_luminance = random.uniform(0.35, 1);
  s.sensor.blur_px = random.uniform(0.5, 1.1);
  s.sensor.sharpening = random.uniform(0, 1.2);
  s.sensor.auto_exposure = random.uniform(0.3, 0.7);
  s.sensor.target_tone = random.uniform(95, 130);
  s.sensor.exposure_spread = random.uniform(0.02, 0.12);
  for (std::uint64_t user = 0; user < 3; ++user)
    rig.users.push_back(random_looks(seed * 3 + user));
  s.hand = rig.users.front();
  rig.contents = {ScreenContent::black, ScreenContent::chat, ScreenContent::white, ScreenContent::photo,
                  ScreenContent::desktop};
  s.content = rig.contents[1 + random.index(rig.contents.size() - 1)];
  if (random.chance(0.4)) {
    static constexpr std::array motions{ScreenMotion::scrolling, ScreenMotion::fading, ScreenMotion::rectangle,
                                        ScreenMotion::flashing};
    s.motion = random.one_of(motions);
  }
  s.sensor.shutter_s = random.uniform(1.0 / 250, 1.0 / 30);
  s.script = random_gestures(rig, 8, seed);
  return rig;
}

}  // namespace telehug
