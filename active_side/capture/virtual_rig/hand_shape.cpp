// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand_shape.hpp"

#include <algorithm>
#include <cmath>

#include "capture/virtual_rig/hand_skeleton.hpp"
#include "capture/virtual_rig/hand_trimmings.hpp"

namespace telehug {
namespace {

constexpr float finger_step_mm = 1.2F;
constexpr float hand_step_mm = 3.5F;
constexpr float patch_step_mm = 0.5F;

// What the end of a finger does when it meets the screen, measured on a fine mesh of the end alone.
struct EndContact {
  cv::Vec3f lowest_mm;
  cv::Vec3f contact_mm;
  bool nail_first = false;
};

cv::Vec3f lowest_of(const TriangleMesh& mesh) {
  const auto lowest = std::min_element(mesh.vertices.begin(), mesh.vertices.end(),
                                       [](const auto& a, const auto& b) { return a.place_mm[2] < b.place_mm[2]; });
  return lowest->place_mm;
}

// What the screen may press flat and 2 mm above it: nothing else of a finger's end need be meshed as finely.
Box3 box_of_lower_side(const std::vector<Limb>& finger, float press_mm) {
  Box3 box = box_around({finger.front()}, 2);
  float lowest_mm = box.high[2];
  for (const Limb& limb : finger) {
    const float upright = limb.flat_axis[2] * limb.flat_axis[2];  // how far an ellipsoid of revolution reaches down
    const float share = std::sqrt(1 - upright + upright * limb.flatness * limb.flatness);
    lowest_mm = std::min({lowest_mm, limb.a[2] - limb.a_radius_mm * share, limb.b[2] - limb.b_radius_mm * share});
  }
  box.high[2] = std::min(box.high[2], lowest_mm + press_mm + 2);
  return box;
}

EndContact contact_of(const FingerEnd& end, const std::vector<Limb>& finger, const HandLooks& looks, float press_mm) {
  DistanceGrid grid(box_of_lower_side(finger, press_mm), patch_step_mm);
  for (const Limb& limb : finger)
    grid.add(limb);
  const TriangleMesh skin = grid.surface({}, 0);
  EndContact contact;
  contact.lowest_mm = lowest_of(skin);
  if (looks.sleeve != Sleeve::glove) {
    const cv::Vec3f nail_mm = lowest_of(nail(end, looks));
    contact.nail_first = nail_mm[2] < contact.lowest_mm[2];
    if (contact.nail_first) {
      contact.lowest_mm = contact.contact_mm = nail_mm;
      return contact;
    }
  }
  // Mean of the area that would lie behind the screen; between mesh vertices the height is linear.
  const float plane_mm = contact.lowest_mm[2] + press_mm;
  cv::Vec3f sum;
  float area = 0;
  for (const MeshTriangle& triangle : skin.triangles) {
    std::array<cv::Vec3f, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = skin.vertices[triangle.corners[i]].place_mm;
    const float below = static_cast<float>((p[0][2] < plane_mm) + (p[1][2] < plane_mm) + (p[2][2] < plane_mm)) / 3;
    if (below == 0) continue;
    const cv::Vec3f normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const float share = below * std::abs(normal[2]);
    sum += (p[0] + p[1] + p[2]) * (share / 3);
    area += share;
  }
  contact.contact_mm = area > 0 ? sum * (1 / area) : contact.lowest_mm;
  contact.contact_mm[2] = plane_mm;
  return contact;
}

cv::Vec3f place_of(const EndContact& end, const FingerPlace& finger) {
  const cv::Vec3f foot(static_cast<float>(finger.foot.x_mm), static_cast<float>(finger.foot.y_mm),
                       static_cast<float>(finger.hover_mm));
  return foot - (finger.hover_mm > 0 ? end.lowest_mm : end.contact_mm);
}

std::vector<Limb> first_finger(const HandSkeleton& skeleton) {
  const auto first = skeleton.pointing_limbs.begin();
  return {first, first + static_cast<std::ptrdiff_t>(skeleton.pointing_limbs.size() / skeleton.pointing)};
}

TriangleMesh coarse_hand(const HandSkeleton& skeleton) {
  DistanceGrid grid(box_around(skeleton.limbs, 2 * hand_step_mm), hand_step_mm);
  for (const Limb& limb : skeleton.limbs)
    grid.add(limb);
  return grid.surface(skeleton.limbs.front().tint, skeleton.limbs.front().gloss);
}

void add_clothes_and_nails(const HandSkeleton& skeleton, const HandLooks& looks, TriangleMesh& mesh) {
  if (!skeleton.clothes.empty()) {
    DistanceGrid cloth(box_around(skeleton.clothes, 2 * hand_step_mm), hand_step_mm);
    for (const Limb& limb : skeleton.clothes)
      cloth.add(limb);
    mesh.append(cloth.surface(skeleton.clothes.front().tint, 0));
  }
  if (looks.sleeve == Sleeve::glove) return;
  for (std::size_t i = 0; i < skeleton.ends.size(); ++i) {
    HandLooks short_nails = looks;
    if (i >= skeleton.pointing) short_nails.nail_mm = std::min(looks.nail_mm, 3.0);
    mesh.append(nail(skeleton.ends[i], short_nails));
  }
  if (looks.ring && skeleton.pointing > 0) mesh.append(ring(skeleton.ring_finger_segment));
}

}  // namespace

cv::Vec3f HandShape::place_for(const FingerPlace& finger) const {
  return place_of({lowest_mm, contact_mm, nail_first}, finger);
}

HandShape hand_shape(const HandPose& pose, const HandLooks& looks) {
  const auto press_mm = static_cast<float>(pose.press_mm);
  HandSkeleton skeleton = hand_skeleton(pose, looks, std::nullopt);
  if (skeleton.pointing == 0) {
    HandShape shape{coarse_hand(skeleton), skeleton.limbs, {}, {}, false};
    add_clothes_and_nails(skeleton, looks, shape.mesh);
    shape.lowest_mm = shape.contact_mm = lowest_of(shape.mesh);
    return shape;
  }
  const EndContact end = contact_of(skeleton.ends[0], first_finger(skeleton), looks, press_mm);
  if (pose.second) {
    // Both ends are alike and alike turned, so what holds for the first holds for the second.
    skeleton = hand_skeleton(pose, looks, place_of(end, *pose.second) - place_of(end, pose.finger));
  }
  HandShape shape{{}, skeleton.limbs, end.lowest_mm, end.contact_mm, end.nail_first};

  const Box3 fine_box = box_around(skeleton.pointing_limbs, 2);
  DistanceGrid fine(fine_box, finger_step_mm);
  for (const Limb& limb : skeleton.limbs)
    fine.add(limb);
  shape.mesh = fine.surface(skeleton.limbs.front().tint, skeleton.limbs.front().gloss);
  TriangleMesh rest = coarse_hand(skeleton);
  std::erase_if(rest.triangles, [&](const MeshTriangle& triangle) {
    return std::all_of(triangle.corners.begin(), triangle.corners.end(), [&](std::uint32_t corner) {
      return fine_box.holds(rest.vertices[corner].place_mm, 2 * finger_step_mm);
    });
  });
  shape.mesh.append(rest);
  add_clothes_and_nails(skeleton, looks, shape.mesh);
  return shape;
}

}  // namespace telehug
