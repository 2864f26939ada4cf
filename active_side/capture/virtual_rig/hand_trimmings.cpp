// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand_trimmings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture/virtual_rig/linear_light.hpp"

namespace telehug {
namespace {

constexpr int nail_rows = 16;
constexpr int nail_columns = 12;
const Tint gold{70, 160, 215};

cv::Vec3f unit(const cv::Vec3f& v) {
  return v * (1 / std::max(1e-6F, static_cast<float>(cv::norm(v))));
}

// Triangles of a sheet whose vertices lie row by row, and its normals.
void close_sheet(TriangleMesh& mesh, int rows, int columns, const cv::Vec3f& outwards, bool two_sided) {
  const auto at = [&](int row, int column) { return static_cast<std::uint32_t>(row * columns + column); };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      mesh.triangles.push_back({{at(row, column), at(row, column + 1), at(row + 1, column)}, two_sided});
      mesh.triangles.push_back({{at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)}, two_sided});
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto& place = [&](int r, int c) -> const cv::Vec3f& {
        return mesh.vertices[at(std::clamp(r, 0, rows - 1), std::clamp(c, 0, columns - 1))].place_mm;
      };
      const cv::Vec3f across = place(row, column + 1) - place(row, column - 1);
      const cv::Vec3f along = place(row + 1, column) - place(row - 1, column);
      cv::Vec3f normal = unit(across.cross(along));
      if (normal.dot(outwards) < 0) normal = -normal;
      mesh.vertices[at(row, column)].normal = normal;
    }
  }
}

}  // namespace

// Across, the plate follows the finger's round (x^2 / r^2 + y^2 / (flatness r)^2 = 1); along, it bends down a little.
TriangleMesh nail(const FingerEnd& end, const HandLooks& looks) {
  const float r = end.radius_mm;
  const auto reach_mm = static_cast<float>(looks.nail_mm);
  const float root = -1.25F * r;          // forwards from the ball's middle
  const float tip = 0.8F * r + reach_mm;  // of the free edge
  const cv::Vec3f skin = skin_light(looks.skin_tone);
  const cv::Vec3f bare{skin[0] * 0.9F + 0.03F, skin[1] * 0.88F + 0.02F, skin[2] * 1.0F + 0.04F};
  const cv::Vec3f free_edge = bare * 0.5F + cv::Vec3f(0.30F, 0.34F, 0.38F) * 0.9F;
  const bool pointed = reach_mm > 3;
  TriangleMesh mesh;
  for (int row = 0; row < nail_rows; ++row) {
    const float t = static_cast<float>(row) / (nail_rows - 1);
    const float forwards = root + t * (tip - root);
    float width = static_cast<float>(looks.nail_width) * r;
    if (t < 0.3F) width *= 0.45F + 0.55F * std::sqrt(std::max(0.0F, 1 - (1 - t / 0.3F) * (1 - t / 0.3F)));
    const float taper_from = pointed ? 0.55F : 0.75F;
    if (t > taper_from) {
      const float s = (t - taper_from) / (1 - taper_from);
      width *= std::sqrt(std::max(0.02F, 1 - (pointed ? 0.97F : 0.7F) * s * s));
    }
    // The bed runs along the finger and drops over its end; what is free goes on straight and a little down.
    const float over = std::max(0.0F, forwards);
    const float drop = over < r ? over * over / (3.2F * r) : r / 3.2F + (over - r) * 0.55F;
    for (int column = 0; column < nail_columns; ++column) {
      const float x = width * (2 * static_cast<float>(column) / (nail_columns - 1) - 1);
      const float height = end.flatness * std::sqrt(std::max(0.0F, r * r - x * x)) + end.nail_proud_mm - drop;
      const bool free = forwards > 0.75F * r;
      const cv::Vec3f tint = looks.polish ? linear(*looks.polish) : free ? free_edge : bare;
      mesh.vertices.push_back(
          {end.middle - end.back * forwards + end.side * x + end.nail * height, {}, tint, looks.polish ? 0.5F : 0.15F});
    }
  }
  close_sheet(mesh, nail_rows, nail_columns, end.nail, true);
  return mesh;
}

TriangleMesh ring(const Limb& segment) {
  constexpr int around = 33;
  constexpr int across = 7;
  const cv::Vec3f axis = unit(segment.b - segment.a);
  const cv::Vec3f up = unit(segment.flat_axis - axis * axis.dot(segment.flat_axis));
  const cv::Vec3f side = axis.cross(up);
  const cv::Vec3f middle = segment.a + (segment.b - segment.a) * 0.62F;
  const float radius = segment.a_radius_mm + 0.62F * (segment.b_radius_mm - segment.a_radius_mm) + 0.4F;
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / (around - 1);
    const cv::Vec3f out = side * std::cos(angle) + up * (std::sin(angle) * segment.flatness);
    for (int j = 0; j < across; ++j) {
      const float turn = std::numbers::pi_v<float> * (static_cast<float>(j) / (across - 1) - 0.5F);
      const cv::Vec3f place = middle + out * (radius + 1.1F * std::cos(turn)) + axis * (1.7F * std::sin(turn));
      mesh.vertices.push_back({place, unit(out * std::cos(turn) + axis * std::sin(turn)), linear(gold), 0.6F});
    }
  }
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(i * across + j); };
  for (int i = 0; i + 1 < around; ++i) {
    for (int j = 0; j + 1 < across; ++j) {
      mesh.triangles.push_back({{at(i, j), at(i, j + 1), at(i + 1, j)}, true});
      mesh.triangles.push_back({{at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)}, true});
    }
  }
  return mesh;
}

}  // namespace telehug
