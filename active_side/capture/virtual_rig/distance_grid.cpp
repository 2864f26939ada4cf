// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/distance_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace telehug {
namespace {

constexpr float far_away_mm = 1e3F;

float smooth_minimum(float a, float b, float blend) {
  const float closeness = std::max(blend - std::abs(a - b), 0.0F) / blend;
  return std::min(a, b) - closeness * closeness * blend / 4;
}

cv::Vec3f lowest(const cv::Vec3f& a, const cv::Vec3f& b) {
  return {std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2])};
}

Box3 box_of(const Limb& limb, float margin_mm) {
  const float reach = std::max(limb.a_radius_mm, limb.b_radius_mm) * std::max(1.0F, limb.flatness) + margin_mm;
  const cv::Vec3f around = cv::Vec3f::all(reach);
  return {lowest(limb.a, limb.b) - around, -lowest(-limb.a, -limb.b) + around};
}

}  // namespace

float distance_mm(const Limb& limb, const cv::Vec3f& place) {
  const cv::Vec3f along = limb.b - limb.a;
  const cv::Vec3f from_a = place - limb.a;
  const float share = std::clamp(from_a.dot(along) / along.dot(along), 0.0F, 1.0F);
  cv::Vec3f away = from_a - along * share;
  const float flat = away.dot(limb.flat_axis);
  const float stretched = flat / limb.flatness;
  away += limb.flat_axis * (stretched - flat);
  const float radius = limb.a_radius_mm + share * (limb.b_radius_mm - limb.a_radius_mm);
  return std::sqrt(away.dot(away)) - radius;
}

bool Box3::holds(const cv::Vec3f& p, float margin) const {
  for (int i = 0; i < 3; ++i) {
    if (p[i] < low[i] + margin || p[i] > high[i] - margin) return false;
  }
  return true;
}

Box3 box_around(const std::vector<Limb>& limbs, float margin_mm) {
  Box3 box{cv::Vec3f::all(std::numeric_limits<float>::max()), cv::Vec3f::all(std::numeric_limits<float>::lowest())};
  for (const Limb& limb : limbs) {
    const Box3 one = box_of(limb, margin_mm);
    box.low = lowest(box.low, one.low);
    box.high = -lowest(-box.high, -one.high);
  }
  return box;
}

DistanceGrid::DistanceGrid(const Box3& box, float step_mm) : origin_(box.low), step_mm_(step_mm) {
  std::size_t count = 1;
  for (int i = 0; i < 3; ++i) {
    size_[i] = static_cast<int>(std::ceil((box.high[i] - box.low[i]) / step_mm)) + 1;
    count *= static_cast<std::size_t>(size_[i]);
  }
  values_.assign(count, far_away_mm);
}

void DistanceGrid::add(const Limb& limb) {
  const Box3 box = box_of(limb, 2 * step_mm_ + limb.blend_mm);
  cv::Vec3i first;
  cv::Vec3i last;
  for (int i = 0; i < 3; ++i) {
    first[i] = std::max(0, static_cast<int>(std::floor((box.low[i] - origin_[i]) / step_mm_)));
    last[i] = std::min(size_[i] - 1, static_cast<int>(std::ceil((box.high[i] - origin_[i]) / step_mm_)));
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const cv::Vec3f place =
            origin_ + cv::Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) * step_mm_;
        float& value = at(x, y, z);
        value = smooth_minimum(value, distance_mm(limb, place), limb.blend_mm);
      }
    }
  }
}

// Central differences of the trilinear field.
cv::Vec3f DistanceGrid::gradient(const cv::Vec3f& p) const {
  const auto value = [&](cv::Vec3f q) {
    std::array<int, 3> cell{};
    cv::Vec3f f;
    for (int i = 0; i < 3; ++i) {
      q[i] = std::clamp(q[i], 0.0F, static_cast<float>(size_[i]) - 1.001F);
      cell[static_cast<std::size_t>(i)] = static_cast<int>(q[i]);
      f[i] = q[i] - std::floor(q[i]);
    }
    const auto [x, y, z] = cell;
    const auto row = [&](int dy, int dz) {
      return at(x, y + dy, z + dz) * (1 - f[0]) + at(x + 1, y + dy, z + dz) * f[0];
    };
    return (row(0, 0) * (1 - f[1]) + row(1, 0) * f[1]) * (1 - f[2]) +
           (row(0, 1) * (1 - f[1]) + row(1, 1) * f[1]) * f[2];
  };
  constexpr float reach = 0.7F;
  cv::Vec3f slope;
  for (int i = 0; i < 3; ++i) {
    cv::Vec3f step;
    step[i] = reach;
    slope[i] = value(p + step) - value(p - step);
  }
  const auto length = static_cast<float>(cv::norm(slope));
  return length > 0 ? slope * (1 / length) : cv::Vec3f(0, 0, 1);
}

TriangleMesh DistanceGrid::surface(const std::vector<Limb>& limbs) const {
  TriangleMesh mesh;
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> vertex_of(values_.size(), none);
  // The surface does not cross a cell whose corner is further away than its diagonal; distances are up to a fifth off.
  const float surely_away = 2.2F * step_mm_;
  static constexpr std::array<std::array<int, 2>, 12> edges{
      {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  const auto corner_place = [](int corner) {
    return cv::Vec3f(static_cast<float>(corner & 1), static_cast<float>((corner >> 1) & 1),
                     static_cast<float>(corner >> 2));
  };
  for (int z = 0; z + 1 < size_[2]; ++z) {
    for (int y = 0; y + 1 < size_[1]; ++y) {
      for (int x = 0; x + 1 < size_[0]; ++x) {
        if (std::abs(at(x, y, z)) > surely_away) continue;
        std::array<float, 8> d{};
        int inside = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const float value = at(x + (corner & 1), y + ((corner >> 1) & 1), z + (corner >> 2));
          d[static_cast<std::size_t>(corner)] = value;
          inside += value < 0 ? 1 : 0;
        }
        if (inside == 0 || inside == 8) continue;
        cv::Vec3f sum;
        float crossings = 0;
        for (const auto& [i, j] : edges) {
          const float di = d[static_cast<std::size_t>(i)];
          const float dj = d[static_cast<std::size_t>(j)];
          if ((di < 0) == (dj < 0)) continue;
          sum += corner_place(i) + (corner_place(j) - corner_place(i)) * (di / (di - dj));
          ++crossings;
        }
        const cv::Vec3f cell(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        const cv::Vec3f place = cell + sum * (1 / crossings);
        vertex_of[index(x, y, z)] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back({origin_ + place * step_mm_, gradient(place), {}, 0});
      }
    }
  }
  // Every edge of the grid that the surface crosses gives a quad of the four cells around it.
  for (int z = 1; z + 1 < size_[2]; ++z) {
    for (int y = 1; y + 1 < size_[1]; ++y) {
      for (int x = 1; x + 1 < size_[0]; ++x) {
        if (std::abs(at(x, y, z)) > surely_away) continue;
        const bool here = at(x, y, z) < 0;
        for (int axis = 0; axis < 3; ++axis) {
          const cv::Vec3i e(axis == 0, axis == 1, axis == 2);
          if (here == (at(x + e[0], y + e[1], z + e[2]) < 0)) continue;
          const cv::Vec3i p(axis == 2, axis == 0, axis == 1);  // the next axis, and the one after it
          const cv::Vec3i q(axis == 1, axis == 2, axis == 0);
          const std::array<std::uint32_t, 4> around{vertex_of[index(x, y, z)],
                                                    vertex_of[index(x - p[0], y - p[1], z - p[2])],
                                                    vertex_of[index(x - p[0] - q[0], y - p[1] - q[1], z - p[2] - q[2])],
                                                    vertex_of[index(x - q[0], y - q[1], z - q[2])]};
          if (here) {
            mesh.triangles.push_back({{around[0], around[1], around[2]}, false});
            mesh.triangles.push_back({{around[0], around[2], around[3]}, false});
          } else {
            mesh.triangles.push_back({{around[0], around[2], around[1]}, false});
            mesh.triangles.push_back({{around[0], around[3], around[2]}, false});
          }
        }
      }
    }
  }
  for (MeshVertex& vertex : mesh.vertices) {
    float nearest = std::numeric_limits<float>::max();
    for (const Limb& limb : limbs) {
      const float distance = distance_mm(limb, vertex.place_mm);
      if (distance >= nearest) continue;
      nearest = distance;
      vertex.tint = limb.tint;
      vertex.gloss = limb.gloss;
    }
  }
  return mesh;
}

}  // namespace telehug
