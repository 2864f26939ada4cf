// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <vector>

namespace telehug {

struct MeshVertex {
  cv::Vec3f place_mm;
  cv::Vec3f normal;  // outwards, length 1
  cv::Vec3f tint;    // linear
  float gloss = 0;   // brightness of a lamp's reflection: skin 0.05, nail polish 0.5
};

struct MeshTriangle {
  std::array<std::uint32_t, 3> corners{};  // seen from outside they turn clockwise or the other way, all alike
  bool two_sided = false;                  // a sheet, such as a nail's end
};

struct TriangleMesh {
  std::vector<MeshVertex> vertices;
  std::vector<MeshTriangle> triangles;

  void append(const TriangleMesh& other) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (MeshTriangle triangle : other.triangles) {
      for (std::uint32_t& corner : triangle.corners)
        corner += first;
      triangles.push_back(triangle);
    }
  }
};

}  // namespace telehug
