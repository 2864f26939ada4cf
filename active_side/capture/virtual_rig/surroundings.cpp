// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "capture/virtual_rig/value_noise.hpp"

namespace telehug {
namespace {

const Tint key_tint{60, 58, 58};
const Tint gap_tint{26, 25, 25};
const Tint coffee_tint{28, 38, 52};
const cv::Vec3f upwards{0, -1, 0};
constexpr double foot_thickness_mm = 8;
constexpr double keyboard_thickness_mm = 14;
constexpr double keyboard_half_width_mm = 215;
constexpr double keyboard_depth_mm = 125;
constexpr double key_pitch_mm = 19;
constexpr double key_gap_mm = 2.5;
constexpr float corner_mm = 6;  // how far the shade in a corner reaches

// 0 inside a rectangle around (0, 0), else the distance from it.
double distance_from_box(double x, double z, double half_width, double half_depth) {
  return std::hypot(std::max(0.0, std::abs(x) - half_width), std::max(0.0, std::abs(z) - half_depth));
}

}  // namespace

Surroundings::Surroundings(const VirtualRigSettings& settings)
    : desk_(settings.desk),
      lighting_(settings.light),
      middle_x_mm_(settings.screen.width_mm / 2),
      desk_y_mm_(settings.screen.height_mm + settings.desk_below_mm),
      keyboard_front_mm_(desk_.foot_front_mm + 20 + 60.0 * static_cast<double>(hashed(1, 0, desk_.seed))),
      keyboard_x_mm_(middle_x_mm_ + 60.0 * static_cast<double>(hashed(2, 0, desk_.seed) - 0.5F)) {
  if (desk_.cup) {
    const double side = hashed(3, 0, desk_.seed) < 0.5F ? -1 : 1;
    cup_ = Cup{
        middle_x_mm_ + side * (150 + 60.0 * static_cast<double>(hashed(4, 0, desk_.seed))),
        90 + 80.0 * static_cast<double>(hashed(5, 0, desk_.seed)),
        38,
        std::min(85.0, desk_y_mm_ - 20),
        {230.0 * static_cast<double>(hashed(6, 0, desk_.seed)), 230.0 * static_cast<double>(hashed(7, 0, desk_.seed)),
         230.0 * static_cast<double>(hashed(8, 0, desk_.seed))}};
  }
}

Seen Surroundings::look(const RigPoint& from, const RigPoint& ray) const {
  if (ray[1] <= 0) return {linear({18, 18, 18}), Surface::nothing, 0};
  if (cup_) {
    if (const auto cup = look_at_cup(from, ray)) return *cup;
  }
  if (desk_.foot_half_width_mm > 0) {
    const double t = (desk_y_mm_ - foot_thickness_mm - from[1]) / ray[1];
    const RigPoint p = from + ray * t;
    const double x = p[0] - middle_x_mm_;
    // Corners rounded by 4 mm.
    if (distance_from_box(x, p[2], desk_.foot_half_width_mm - 4, desk_.foot_front_mm - 4) < 4) {
      const auto shade = static_cast<float>(0.75 + 0.25 * std::tanh((p[2] + 30) / 60));
      return {product(linear(desk_.foot_tint), lighting_.on(upwards, shade)), Surface::foot, t};
    }
  }
  if (desk_.keyboard) {
    const double t = (desk_y_mm_ - keyboard_thickness_mm - from[1]) / ray[1];
    const RigPoint p = from + ray * t;
    const double x = p[0] - keyboard_x_mm_ + keyboard_half_width_mm;
    const double z = p[2] - keyboard_front_mm_;
    if (x >= 0 && x <= 2 * keyboard_half_width_mm && z >= 0 && z <= keyboard_depth_mm) {
      const double row = std::floor((z - 8) / key_pitch_mm);
      const double in_row = z - 8 - row * key_pitch_mm;
      const double in_column = std::fmod(x + 5 * row + 100 * key_pitch_mm, key_pitch_mm);
      const bool key = z > 8 && in_row > key_gap_mm && in_column > key_gap_mm;
      const float edge = key && in_row > key_pitch_mm - 2 ? 1.35F : 1.0F;
      return {product(linear(key ? key_tint : gap_tint), lighting_.on(upwards)) * edge, Surface::keyboard, t};
    }
  }
  const double t = (desk_y_mm_ - from[1]) / ray[1];
  const RigPoint p = from + ray * t;
  return {desk_light(static_cast<float>(p[0]), static_cast<float>(p[2])), Surface::desk, t};
}

// A cylinder that stands on the desk, with something dark in it.
std::optional<Seen> Surroundings::look_at_cup(const RigPoint& from, const RigPoint& ray) const {
  const double top_t = (desk_y_mm_ - cup_->height_mm - from[1]) / ray[1];
  const RigPoint top = from + ray * top_t;
  const double from_middle = std::hypot(top[0] - cup_->x_mm, top[2] - cup_->z_mm);
  if (from_middle < cup_->radius_mm - 4) {
    return Seen{product(linear(coffee_tint), lighting_.on(upwards, 0.6F)), Surface::cup_inside, top_t};
  }
  if (from_middle < cup_->radius_mm)
    return Seen{product(linear(cup_->tint), lighting_.on(upwards)), Surface::cup, top_t};
  // Side: |(x, z) - axis| = radius, quadratic in t.
  const double ox = from[0] - cup_->x_mm;
  const double oz = from[2] - cup_->z_mm;
  const double a = ray[0] * ray[0] + ray[2] * ray[2];
  const double b = ox * ray[0] + oz * ray[2];
  const double c = ox * ox + oz * oz - cup_->radius_mm * cup_->radius_mm;
  const double discriminant = b * b - a * c;
  if (a <= 0 || discriminant < 0) return std::nullopt;
  const double t = (-b - std::sqrt(discriminant)) / a;
  const RigPoint p = from + ray * t;
  if (t <= top_t || p[1] > desk_y_mm_) return std::nullopt;
  const cv::Vec3f normal(static_cast<float>((p[0] - cup_->x_mm) / cup_->radius_mm), 0,
                         static_cast<float>((p[2] - cup_->z_mm) / cup_->radius_mm));
  const auto openness = static_cast<float>(0.25 + 0.4 * (desk_y_mm_ - p[1]) / cup_->height_mm);
  return Seen{product(linear(cup_->tint), lighting_.on(normal, openness)), Surface::cup, t};
}

Light Surroundings::desk_light(float x_mm, float z_mm) const {
  // Less light behind the monitor, and in the corners around what stands on the desk.
  float openness = 0.75F + 0.25F * std::tanh((z_mm + 30) / 60);
  const auto corner = [&](double distance_mm, float reach_mm) {
    openness *= 1 - 0.45F * std::exp(-static_cast<float>(distance_mm) / reach_mm);
  };
  if (desk_.foot_half_width_mm > 0) {
    corner(distance_from_box(static_cast<double>(x_mm) - middle_x_mm_, static_cast<double>(z_mm),
                             desk_.foot_half_width_mm, desk_.foot_front_mm),
           corner_mm);
  }
  if (desk_.keyboard) {
    corner(distance_from_box(static_cast<double>(x_mm) - keyboard_x_mm_,
                             static_cast<double>(z_mm) - keyboard_front_mm_ - keyboard_depth_mm / 2,
                             keyboard_half_width_mm, keyboard_depth_mm / 2),
           corner_mm);
  }
  if (cup_) {
    const double distance =
        std::hypot(static_cast<double>(x_mm) - cup_->x_mm, static_cast<double>(z_mm) - cup_->z_mm) - cup_->radius_mm;
    corner(std::max(0.0, distance), 3 * corner_mm);
  }
  return product(desk_tint(x_mm, z_mm), lighting_.on(upwards, openness));
}

Light Surroundings::desk_tint(float x_mm, float z_mm) const {
  const Light tint = linear(desk_.tint);
  const std::uint64_t seed = desk_.seed;
  switch (desk_.kind) {
    case DeskKind::plain:
      return tint * (0.97F + 0.06F * fractal_noise(x_mm * 0.02F, z_mm * 0.02F, seed));
    case DeskKind::wood: {
      // Fibres along x, year rings as bent bands, boards of 140 mm.
      const float board = std::floor(z_mm / 140);
      const float shifted = x_mm + 900 * hashed(static_cast<std::int64_t>(board), 0, seed + 9);
      const float bend = 9 * value_noise(shifted * 0.004F, z_mm * 0.02F, seed);
      const float rings = 0.5F + 0.5F * std::sin(0.35F * z_mm + bend);
      const float fibre = value_noise(shifted * 0.012F, z_mm * 1.1F, seed + 1);
      const float cloud = value_noise(shifted * 0.006F, z_mm * 0.03F, seed + 2);
      return tint * (0.62F + 0.25F * rings * cloud + 0.25F * fibre + 0.25F * cloud);
    }
    case DeskKind::stone: {
      const float grain = fractal_noise(x_mm * 0.15F, z_mm * 0.15F, seed);
      const float vein = std::abs(fractal_noise(x_mm * 0.012F, z_mm * 0.012F, seed + 5) - 0.5F);
      return tint * (0.55F + 0.8F * grain) * (0.75F + std::min(0.25F, 4 * vein));
    }
  }
  return tint;
}

}  // namespace telehug
