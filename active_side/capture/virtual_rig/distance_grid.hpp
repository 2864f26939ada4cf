// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "capture/virtual_rig/triangle_mesh.hpp"

namespace telehug {

// A ball swept from a to b while its radius changes, pressed flat along an axis: what hands are made of here.
struct Limb {
  cv::Vec3f a;
  cv::Vec3f b;
  float a_radius_mm = 0;
  float b_radius_mm = 0;
  cv::Vec3f flat_axis{0, 0, 1};  // length 1
  float flatness = 1;            // thickness along flat_axis as a share of the width
  float blend_mm = 2;            // how softly it goes over into what is there already
  cv::Vec3f tint;                // linear
  float gloss = 0;
};

// Distance from the surface of a limb, about: exact on the surface, negative inside.
float distance_mm(const Limb& limb, const cv::Vec3f& place);

// Box around limbs, wider by a margin.
struct Box3 {
  cv::Vec3f low;
  cv::Vec3f high;

  [[nodiscard]] bool holds(const cv::Vec3f& p, float margin) const;
};
Box3 box_around(const std::vector<Limb>& limbs, float margin_mm);

// The smooth union of limbs, sampled on a grid, and its surface as a mesh by the method of surface nets (Gibson 1998):
// one vertex in every cell that the surface crosses, at the mean of its crossings with the cell's edges. Only blocks of
// the grid near the surface are looked at.
class DistanceGrid {
 public:
  DistanceGrid(const Box3& box, float step_mm);

  // Blends with what was added before (polynomial smooth minimum, Quilez 2013).
  void add(const Limb& limb);

  [[nodiscard]] TriangleMesh surface(const cv::Vec3f& tint, float gloss) const;

 private:
  [[nodiscard]] float at(int x, int y, int z) const { return values_[index(x, y, z)]; }
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] std::size_t block_index(const cv::Vec3i& block) const {
    const int index = (block[2] * blocks_[1] + block[1]) * blocks_[0] + block[0];
    return static_cast<std::size_t>(index);
  }
  void add_to_block(const Limb& limb, const cv::Vec3i& block);
  void fill_block(const cv::Vec3i& block, float at_most_mm);
  [[nodiscard]] cv::Vec3f gradient(const cv::Vec3i& cell, const cv::Vec3f& in_cell) const;

  // Calls step(x, y, z) for the cells of the blocks that the surface may cross, from sample `from` on along each axis.
  template <typename Step>
  void near_surface(int from, Step&& step) const;

  cv::Vec3f origin_;
  float step_mm_;
  cv::Vec3i blocks_;
  cv::Vec3i size_;  // of samples: whole blocks
  std::vector<float> values_;
  std::vector<std::uint8_t> near_;  // of blocks: whether some limb's surface may cross it
};

}  // namespace telehug
