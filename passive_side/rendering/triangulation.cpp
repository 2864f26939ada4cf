// SPDX-License-Identifier: Apache-2.0
#include "rendering/triangulation.hpp"

#include <algorithm>
#include <tuple>

#include "rendering/geometry.hpp"

namespace telehug {
namespace {

using Edge = std::array<std::size_t, 2>;
using Triangle = std::array<std::size_t, 3>;

// A node so near to the line between two others lies on it.
constexpr double on_line_fh = least_distance_fh / 2;

class Mesher {
 public:
  explicit Mesher(std::span<const BodyPoint> nodes) : nodes_(nodes) {}

  [[nodiscard]] Triangulation mesh() {
    for (const Edge& edge : pairs_by_length()) {
      if (!leads_over_a_node(edge) && !crosses_one(edge)) made_.edges.push_back(edge);
    }
    for (std::size_t a = 0; a < nodes_.size(); ++a)
      for (std::size_t b = a + 1; b < nodes_.size(); ++b)
        for (std::size_t c = b + 1; c < nodes_.size(); ++c)
          if (is_face({a, b, c})) made_.triangles.push_back({a, b, c});
    return std::move(made_);
  }

 private:
  [[nodiscard]] std::vector<Edge> pairs_by_length() const {
    std::vector<Edge> pairs;
    for (std::size_t a = 0; a < nodes_.size(); ++a)
      for (std::size_t b = a + 1; b < nodes_.size(); ++b)
        pairs.push_back({a, b});
    std::ranges::sort(pairs, {}, [this](const Edge& pair) {
      return std::tuple(distance_fh(nodes_[pair[0]], nodes_[pair[1]]), pair);
    });
    return pairs;
  }

  [[nodiscard]] bool leads_over_a_node(const Edge& edge) const {
    const BodyPoint from = nodes_[edge[0]];
    const BodyPoint to = nodes_[edge[1]];
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (node == edge[0] || node == edge[1]) continue;
      const double part = part_nearest(nodes_[node], from, to);
      if (part > 0 && part < 1 && distance_fh(nodes_[node], point_between(from, to, part)) < on_line_fh) return true;
    }
    return false;
  }

  [[nodiscard]] bool crosses_one(const Edge& edge) const {
    const auto apart = [this](const Edge& line, const Edge& ends) {
      const BodyPoint a = nodes_[line[0]];
      const BodyPoint b = nodes_[line[1]];
      return turn(a, b, nodes_[ends[0]]) * turn(a, b, nodes_[ends[1]]) < 0;
    };
    return std::ranges::any_of(made_.edges, [&](const Edge& other) {
      const bool meet = std::ranges::find_first_of(edge, other) != edge.end();
      return !meet && apart(edge, other) && apart(other, edge);
    });
  }

  [[nodiscard]] bool joined(std::size_t a, std::size_t b) const {
    return std::ranges::find(made_.edges, Edge{a, b}) != made_.edges.end();
  }

  [[nodiscard]] bool is_face(const Triangle& corners) const {
    const auto [a, b, c] = corners;
    if (!joined(a, b) || !joined(b, c) || !joined(a, c)) return false;
    const double area = turn(nodes_[a], nodes_[b], nodes_[c]);
    if (area == 0) return false;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (node == a || node == b || node == c) continue;
      const BodyPoint p = nodes_[node];
      const bool inside = turn(nodes_[a], nodes_[b], p) / area > 0 && turn(nodes_[b], nodes_[c], p) / area > 0 &&
                          turn(nodes_[c], nodes_[a], p) / area > 0;
      if (inside) return false;
    }
    return true;
  }

  std::span<const BodyPoint> nodes_;
  Triangulation made_;
};

}  // namespace

Triangulation triangulate(std::span<const BodyPoint> nodes) {
  return Mesher(nodes).mesh();
}

}  // namespace telehug
