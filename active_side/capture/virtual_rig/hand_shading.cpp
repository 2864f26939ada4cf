// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand_shading.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

constexpr float screen_reach_mm = 180;  // from this far on the screen fills less and less of what a finger sees
constexpr float screen_to_user = 1.4F;  // a screen is brighter from the front than at the camera's grazing angle
constexpr float desk_bounce = 0.5F;     // light from below as a share of that from above

// To the power of 24, a soft gloss.
float shine(float facing) {
  const float squared = facing * facing;
  const float eighth = squared * squared * (squared * squared);
  return eighth * eighth * eighth;
}

Light reflection(const MeshVertex& vertex, const cv::Vec3f& normal, const cv::Vec3f& to_eye,
                 const RoomLighting& lighting, const Light& lamp) {
  const cv::Vec3f half = lighting.towards() + to_eye;
  const float facing = normal.dot(half) / std::sqrt(half.dot(half));
  if (facing <= 0) return {};
  return lamp * (vertex.gloss * shine(facing));
}

}  // namespace

void light_hand(const HandShape& shape, const FingerPlace& finger, const RoomLighting& lighting,
                const ShownPicture& shown, const PinholeCamera& camera, SeenHand& seen) {
  const cv::Vec3f origin = shape.place_for(finger);
  const PinholeProjection project = camera.projection();
  const Light lamp = lighting.on(lighting.towards());
  const std::size_t count = shape.mesh.vertices.size();
  seen.direct.resize(count);
  seen.mirrored.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const MeshVertex& vertex = shape.mesh.vertices[i];
    cv::Vec3f place = vertex.place_mm + origin;
    cv::Vec3f normal = vertex.normal;
    place[2] = std::max(place[2], 0.0F);  // what the screen presses flat
    const float height = place[2];

    const float before_screen = 1 / (1 + height * height / (screen_reach_mm * screen_reach_mm));
    const float to_screen = 0.5F * (1 - normal[2]) * before_screen;
    const float from_below = 0.5F * (1 + normal[1]);
    const float openness = (1 - to_screen) * (1 - (1 - desk_bounce) * from_below);
    const Light screen = shown.around(place[0], place[1]);
    Light light = product(vertex.tint, lighting.on(normal, openness) + screen * (screen_to_user * to_screen));
    const cv::Vec3f ray = project.position_mm - place;
    light += reflection(vertex, normal, ray * (1 / std::sqrt(ray.dot(ray))), lighting, lamp);
    light *= lighting.near_screen(height);

    const auto [u_px, v_px, depth_mm] = project(place);
    seen.direct[i] = {u_px, v_px, depth_mm, light, height};
    const auto [mirrored_u_px, mirrored_v_px, mirrored_depth_mm] = project({place[0], place[1], -height});
    seen.mirrored[i] = {mirrored_u_px, mirrored_v_px, mirrored_depth_mm, light, height};
  }
}

}  // namespace telehug
