// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/distance_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace telehug {
namespace {

constexpr float far_away_mm = 1e3F;
constexpr int block = 8;  // samples along each axis
// The surface does not cross a cell whose corner is further away than its diagonal; distances along the flat axis are
// too large by 1 / flatness, 1.45 at the most.
constexpr float surely_away_steps = 2.6F;

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
  for (int i = 0; i < 3; ++i) {
    const int samples = static_cast<int>(std::ceil((box.high[i] - box.low[i]) / step_mm)) + 1;
    blocks_[i] = (samples + block - 1) / block;
    size_[i] = blocks_[i] * block;
  }
  values_.assign(index(0, 0, size_[2]), far_away_mm);
  near_.assign(block_index({0, 0, blocks_[2]}), 0);
}

void DistanceGrid::add(const Limb& limb) {
  const float margin_mm = surely_away_steps * step_mm_ + limb.blend_mm;
  const Box3 box = box_of(limb, margin_mm);
  cv::Vec3i first;
  cv::Vec3i last;
  for (int i = 0; i < 3; ++i) {
    const float block_mm = step_mm_ * block;
    first[i] = std::max(0, static_cast<int>(std::floor((box.low[i] - origin_[i]) / block_mm)));
    last[i] = std::min(blocks_[i] - 1, static_cast<int>(std::floor((box.high[i] - origin_[i]) / block_mm)));
  }
  // How much distance_mm() can change over the way from a block's middle to its corner.
  const float taper = std::abs(limb.b_radius_mm - limb.a_radius_mm) / static_cast<float>(cv::norm(limb.b - limb.a));
  const float half = (block - 1) / 2.0F;
  const float change_mm = half * std::sqrt(3.0F) * step_mm_ * (1 / std::min(1.0F, limb.flatness) + taper);
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const cv::Vec3f middle(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        const float distance = distance_mm(limb, origin_ + (middle * float{block} + cv::Vec3f::all(half)) * step_mm_);
        if (distance - change_mm > margin_mm) continue;
        if (distance + change_mm < -margin_mm) {  // deep inside only the sign matters
          fill_block({x, y, z}, distance + change_mm);
        } else {
          near_[block_index({x, y, z})] = 1;
          add_to_block(limb, {x, y, z});
        }
      }
    }
  }
}

void DistanceGrid::fill_block(const cv::Vec3i& which, float at_most_mm) {
  for (int z = which[2] * block; z < (which[2] + 1) * block; ++z) {
    for (int y = which[1] * block; y < (which[1] + 1) * block; ++y) {
      float* row = &values_[index(which[0] * block, y, z)];
      for (int i = 0; i < block; ++i)
        row[i] = std::min(row[i], at_most_mm);
    }
  }
}

// distance_mm() for the samples of a block, its products of vectors written as polynomials of the way along a row.
void DistanceGrid::add_to_block(const Limb& limb, const cv::Vec3i& which) {
  const cv::Vec3f along = limb.b - limb.a;
  const float length2 = along.dot(along);
  const float along_flat = along.dot(limb.flat_axis);
  const float stretch = 1 / (limb.flatness * limb.flatness) - 1;
  const float taper = limb.b_radius_mm - limb.a_radius_mm;
  const float blend = limb.blend_mm;
  for (int z = which[2] * block; z < (which[2] + 1) * block; ++z) {
    for (int y = which[1] * block; y < (which[1] + 1) * block; ++y) {
      const cv::Vec3f first(static_cast<float>(which[0] * block), static_cast<float>(y), static_cast<float>(z));
      const cv::Vec3f from_a = origin_ + first * step_mm_ - limb.a;
      const float across2 = from_a[1] * from_a[1] + from_a[2] * from_a[2];
      const float start = from_a.dot(along);
      const float start_flat = from_a.dot(limb.flat_axis);
      float* row = &values_[index(which[0] * block, y, z)];
      for (int i = 0; i < block; ++i) {
        const float way = static_cast<float>(i) * step_mm_;
        const float x = from_a[0] + way;
        const float dot = start + way * along[0];
        const float share = std::min(1.0F, std::max(0.0F, dot / length2));
        const float away2 = x * x + across2 - share * (2 * dot - share * length2);
        const float flat = start_flat + way * limb.flat_axis[0] - share * along_flat;
        const float distance =
            std::sqrt(std::max(0.0F, away2 + stretch * flat * flat)) - limb.a_radius_mm - share * taper;
        const float before = row[i];
        const float closeness = std::max(blend - std::abs(before - distance), 0.0F);
        row[i] = std::min(before, distance) - closeness * closeness / (4 * blend);
      }
    }
  }
}

// Central differences over 0.7 steps of the trilinear field: along each axis four samples, each the mean of four rows
// by their nearness.
cv::Vec3f DistanceGrid::gradient(const cv::Vec3i& cell, const cv::Vec3f& f) const {
  constexpr float reach = 0.7F;
  const std::array<std::ptrdiff_t, 3> stride{1, size_[0], static_cast<std::ptrdiff_t>(size_[0]) * size_[1]};
  const float* here = &values_[index(cell[0], cell[1], cell[2])];
  cv::Vec3f slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t p = (axis + 1) % 3;
    const std::size_t q = (axis + 2) % 3;
    const float fp = f[static_cast<int>(p)];
    const float fq = f[static_cast<int>(q)];
    const auto sample = [&](int i) {
      const float* s = here + i * stride[axis];
      return (s[0] * (1 - fp) + s[stride[p]] * fp) * (1 - fq) +
             (s[stride[q]] * (1 - fp) + s[stride[p] + stride[q]] * fp) * fq;
    };
    const auto value = [&](float place) {
      const float from = std::floor(place);
      const int i = static_cast<int>(from);
      const float a = sample(i);
      return a + (sample(i + 1) - a) * (place - from);
    };
    const float middle = f[static_cast<int>(axis)];
    slope[static_cast<int>(axis)] = value(middle + reach) - value(middle - reach);
  }
  const auto length = std::sqrt(slope.dot(slope));
  return length > 0 ? slope * (1 / length) : cv::Vec3f(0, 0, 1);
}

template <typename Step>
void DistanceGrid::near_surface(int from, Step&& step) const {
  for (int block_z = 0; block_z < blocks_[2]; ++block_z) {
    for (int block_y = 0; block_y < blocks_[1]; ++block_y) {
      for (int block_x = 0; block_x < blocks_[0]; ++block_x) {
        if (near_[block_index({block_x, block_y, block_z})] == 0) continue;
        const auto first = [&](int which) { return std::max(from, which * block); };
        const auto end = [&](int which, int axis) { return std::min(size_[axis] - 2, (which + 1) * block); };
        for (int z = first(block_z); z < end(block_z, 2); ++z) {
          for (int y = first(block_y); y < end(block_y, 1); ++y) {
            for (int x = first(block_x); x < end(block_x, 0); ++x)
              step(x, y, z);
          }
        }
      }
    }
  }
}

TriangleMesh DistanceGrid::surface(const cv::Vec3f& tint, float gloss) const {
  TriangleMesh mesh;
  // Only of cells that the surface crosses.
  const auto vertex_of = std::make_unique_for_overwrite<std::uint32_t[]>(values_.size());
  const float surely_away = surely_away_steps * step_mm_;
  static constexpr std::array<std::array<int, 2>, 12> edges{
      {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  const auto corner_place = [](int corner) {
    return cv::Vec3f(static_cast<float>(corner & 1), static_cast<float>((corner >> 1) & 1),
                     static_cast<float>(corner >> 2));
  };
  const std::size_t row = static_cast<std::size_t>(size_[0]);
  const std::size_t layer = row * static_cast<std::size_t>(size_[1]);
  near_surface(1, [&](int x, int y, int z) {
    const std::size_t cell = index(x, y, z);
    if (std::abs(values_[cell]) > surely_away) return;
    const float* v = &values_[cell];
    const std::array<float, 8> d{v[0],     v[1],         v[row],         v[row + 1],
                                 v[layer], v[layer + 1], v[layer + row], v[layer + row + 1]};
    int inside = 0;
    for (const float value : d)
      inside += value < 0 ? 1 : 0;
    if (inside == 0 || inside == 8) return;
    cv::Vec3f sum;
    float crossings = 0;
    for (const auto& [i, j] : edges) {
      const float di = d[static_cast<std::size_t>(i)];
      const float dj = d[static_cast<std::size_t>(j)];
      if ((di < 0) == (dj < 0)) continue;
      sum += corner_place(i) + (corner_place(j) - corner_place(i)) * (di / (di - dj));
      ++crossings;
    }
    const cv::Vec3f in_cell = sum * (1 / crossings);
    const cv::Vec3f place = cv::Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) + in_cell;
    vertex_of[cell] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({origin_ + place * step_mm_, gradient({x, y, z}, in_cell), tint, gloss});
  });
  // Every edge of the grid that the surface crosses gives a quad of the four cells around it.
  const std::array<std::size_t, 3> stride{1, row, layer};
  near_surface(2, [&](int x, int y, int z) {
    const std::size_t cell = index(x, y, z);
    const float value = values_[cell];
    if (std::abs(value) > surely_away) return;
    const bool here = value < 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (here == (values_[cell + stride[axis]] < 0)) continue;
      const std::size_t p = stride[(axis + 1) % 3];
      const std::size_t q = stride[(axis + 2) % 3];
      const std::array<std::uint32_t, 4> around{vertex_of[cell], vertex_of[cell - p], vertex_of[cell - p - q],
                                                vertex_of[cell - q]};
      if (here) {
        mesh.triangles.push_back({{around[0], around[1], around[2]}, false});
        mesh.triangles.push_back({{around[0], around[2], around[3]}, false});
      } else {
        mesh.triangles.push_back({{around[0], around[2], around[1]}, false});
        mesh.triangles.push_back({{around[0], around[3], around[2]}, false});
      }
    }
  });
  return mesh;
}

}  // namespace telehug
