// SPDX-License-Identifier: Apache-2.0
#include "rendering/motor_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/geometry.hpp"
#include "rendering/triangulation.hpp"

namespace telehug {
namespace {

// On an edge rounding may make a weight of 0 a hair less.
constexpr double rounding = 1e-9;

}  // namespace

MotorMesh::MotorMesh(const JacketProfile& profile, BodySide side) {
  if (profile.uncovered == Uncovered::nearest) reach_fh_ = std::numeric_limits<double>::infinity();
  for (std::size_t index = 0; index < std::min(profile.actuators.size(), max_actuators); ++index) {
    const Actuator& actuator = profile.actuators[index];
    const bool turns = actuator.enabled && actuator.kind == ActuatorKind::motor && actuator.max_strength > 0;
    if (turns && actuator.side == side && finite(actuator.place)) add(actuator.place, index);
  }
  std::vector<BodyPoint> places;
  places.reserve(nodes_.size());
  for (const Node& node : nodes_)
    places.push_back(node.place);
  const Triangulation mesh = triangulate(places);
  edges_ = mesh.edges;
  for (const auto& triangle : mesh.triangles)
    add_triangle(triangle);
  if (edges_.empty()) return;

  std::vector<double> nearest_fh(nodes_.size(), std::numeric_limits<double>::infinity());
  for (const auto& [a, b] : edges_) {
    const double length_fh = distance_fh(places[a], places[b]);
    nearest_fh[a] = std::min(nearest_fh[a], length_fh);
    nearest_fh[b] = std::min(nearest_fh[b], length_fh);
  }
  pitch_fh_ = 0;
  for (const double length_fh : nearest_fh)
    pitch_fh_ += length_fh / static_cast<double>(nodes_.size());
}

void MotorMesh::add(BodyPoint place, std::size_t motor) {
  const auto same = std::ranges::find_if(
      nodes_, [place](const Node& node) { return distance_fh(node.place, place) < least_distance_fh; });
  if (same == nodes_.end()) {
    nodes_.push_back({place, {motor}});
  } else {
    same->motors.push_back(motor);
  }
}

void MotorMesh::add_triangle(const std::array<std::size_t, 3>& nodes) {
  Triangle triangle{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const std::size_t own = nodes[corner];
    const BodyPoint a = nodes_[own].place;
    const BodyPoint b = nodes_[nodes[(corner + 1) % 3]].place;
    const BodyPoint c = nodes_[nodes[(corner + 2) % 3]].place;
    const double area = turn(b, c, a);
    const double per_x = (b.y_fh - c.y_fh) / area;
    const double per_y = (c.x_fh - b.x_fh) / area;
    triangle[corner] = {own, -(per_x * b.x_fh + per_y * b.y_fh), per_x, per_y};
  }
  triangles_.push_back(triangle);
}

MotorMesh::Weights MotorMesh::within_a_triangle(BodyPoint place) const {
  Weights found;
  for (const Triangle& triangle : triangles_) {
    const std::array weights{triangle[0].weight_at(place), triangle[1].weight_at(place), triangle[2].weight_at(place)};
    if (std::ranges::min(weights) < -rounding) continue;
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (weights[corner] > 0) found.push_back({triangle[corner].node, std::min(weights[corner], 1.0)});
    return found;
  }
  return found;
}

MotorMesh::Weights MotorMesh::weights_at(BodyPoint touched) const {
  if (!finite(touched) || nodes_.empty()) return {};
  const BodyPoint place = on_a_body(touched);
  Weights found = within_a_triangle(place);
  if (!found.empty()) return found;

  double nearest_fh = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : edges_) {
    const double part = std::clamp(part_nearest(place, nodes_[a].place, nodes_[b].place), 0.0, 1.0);
    const double away_fh = distance_fh(place, point_between(nodes_[a].place, nodes_[b].place, part));
    if (away_fh >= nearest_fh) continue;
    nearest_fh = away_fh;
    found.clear();
    if (part < 1) found.push_back({a, 1 - part});
    if (part > 0) found.push_back({b, part});
  }
  if (edges_.empty()) {
    nearest_fh = distance_fh(place, nodes_[0].place);
    found.push_back({0, 1});
  }
  if (nearest_fh > reach_fh_) found.clear();
  return found;
}

Spot MotorMesh::at(BodyPoint place) const {
  Spot spot;
  for (const auto& [node, weight] : weights_at(place)) {
    const auto& motors = nodes_[node].motors;
    for (const std::size_t motor : motors)
      spot.push_back({motor, std::sqrt(weight / static_cast<double>(motors.size()))});
  }
  return spot;
}

Spot MotorMesh::passed(BodyPoint from, BodyPoint to) const {
  Spot spot;
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    const double part = part_nearest(nodes_[node].place, from, to);
    if (part <= 0 || part > 1) continue;
    const auto& motors = nodes_[node].motors;
    for (const auto& [near, weight] : weights_at(point_between(from, to, part))) {
      if (near != node) continue;
      for (const std::size_t motor : motors)
        spot.push_back({motor, std::sqrt(weight / static_cast<double>(motors.size()))});
    }
  }
  return spot;
}

bool MotorMesh::inside(BodyPoint place) const {
  return finite(place) && !within_a_triangle(place).empty();
}

}  // namespace telehug
