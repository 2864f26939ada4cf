// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "capture/virtual_rig/linear_light.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// What a pixel looks at.
enum class Surface : std::uint8_t {
  nothing,
  screen,
  bezel_front,
  bezel_edge,
  frame,
  desk,
  foot,
  keyboard,
  cup,
  cup_inside
};

struct Seen {
  Light light;
  Surface surface = Surface::nothing;
  double distance = 0;  // in lengths of the ray's direction
};

// What lies in front of the monitor: desk, monitor foot, keyboard, cup, in the room's light.
class Surroundings {
 public:
  explicit Surroundings(const VirtualRigSettings& settings);
  [[nodiscard]] Seen look(const RigPoint& from, const RigPoint& ray) const;

  [[nodiscard]] double desk_y_mm() const noexcept { return desk_y_mm_; }

 private:
  struct Cup {
    double x_mm;
    double z_mm;
    double radius_mm;
    double height_mm;
    Tint tint;
  };

  [[nodiscard]] Light desk_light(float x_mm, float z_mm) const;
  [[nodiscard]] Light desk_tint(float x_mm, float z_mm) const;
  [[nodiscard]] std::optional<Seen> look_at_cup(const RigPoint& from, const RigPoint& ray) const;

  DeskLooks desk_;
  RoomLighting lighting_;
  double middle_x_mm_;
  double desk_y_mm_;
  double keyboard_front_mm_;  // its edge nearest the monitor
  double keyboard_x_mm_;
  std::optional<Cup> cup_;
};

}  // namespace telehug
