// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "common/units.hpp"

namespace telehug {

// Nodes joined to neighbours; numbers are places in the list of nodes.
struct Triangulation {
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<std::array<std::size_t, 3>> triangles;  // fill the nodes' convex hull, without overlapping
};

// The greedy triangulation: from the shortest pair on, every pair is joined that crosses no shorter one. Two motors
// make one felt place between them the better the nearer they are, so the shortest pairs are those that are wanted.
// Nodes on one line have edges and no triangle. Any two nodes are at least `least_distance_fh` apart.
[[nodiscard]] Triangulation triangulate(std::span<const BodyPoint> nodes);

inline constexpr double least_distance_fh = 0.02;

}  // namespace telehug
