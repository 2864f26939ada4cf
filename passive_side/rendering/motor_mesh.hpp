// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <vector>

#include "jacket/jacket_profile.hpp"
#include "rendering/spot.hpp"

namespace telehug {

// A place so near to the mesh of motors is covered by it: half a box.
inline constexpr double cover_radius_fh = standard_box_side_fh / 2;

// The motors of one side of the body as nodes of a mesh of triangles, and how a touch anywhere is shared among them.
//
// Between two motors a touch is felt at one place although there is no motor (phantom sensation). In the energy model
// of Israr & Poupyrev (2011) a part b of the way from the first to the second takes amplitudes sqrt(1 - b) and sqrt(b).
// Over a triangle the same holds with barycentric weights w: amplitudes sqrt(w). So the energies, which are the
// squares, add up to the touch's own, and their centre is the place of the touch; and since a weight falls to 0 towards
// the opposite edge, nothing jumps where a finger goes from one triangle to the next.
//
// Outside of the mesh a touch is felt at the mesh's nearest place; farther out than cover_radius_fh only if the profile
// says Uncovered::nearest. Motors that are switched off, or are allowed nothing, are not in the mesh: their neighbours
// take their part. Motors at one place share it equally.
class MotorMesh {
 public:
  MotorMesh(const JacketProfile& profile, BodySide side);

  [[nodiscard]] bool empty() const noexcept { return nodes_.empty(); }

  // Empty where nothing covers the place, or where it is no place.
  [[nodiscard]] Spot at(BodyPoint place) const;

  // The motors that the straight way from..to (finite) leads past, each with its amplitude where it is nearest. One
  // that the way only comes nearer to is not passed yet.
  [[nodiscard]] Spot passed(BodyPoint from, BodyPoint to) const;

  // Whether the place lies between motors.
  [[nodiscard]] bool inside(BodyPoint place) const;

  // How far it is from a motor to the nearest other one, on average; a box's side if there is none.
  [[nodiscard]] double pitch_fh() const noexcept { return pitch_fh_; }

 private:
  struct Node {
    BodyPoint place;
    std::vector<std::size_t> motors;  // in the profile's order
  };
  struct Weight {
    std::size_t node;
    double weight;
  };
  using Weights = boost::container::static_vector<Weight, 3>;  // above 0, together 1
  // The weight of one corner of a triangle: 1 there, 0 on the edge between the others.
  struct Corner {
    std::size_t node;
    double base, per_x, per_y;

    [[nodiscard]] double weight_at(BodyPoint place) const noexcept {
      return base + per_x * place.x_fh + per_y * place.y_fh;
    }
  };
  using Triangle = std::array<Corner, 3>;

  void add(BodyPoint place, std::size_t motor);
  void add_triangle(const std::array<std::size_t, 3>& nodes);
  [[nodiscard]] Weights within_a_triangle(BodyPoint place) const;
  [[nodiscard]] Weights weights_at(BodyPoint touched) const;

  std::vector<Node> nodes_;
  std::vector<std::array<std::size_t, 2>> edges_;
  std::vector<Triangle> triangles_;
  double pitch_fh_ = standard_box_side_fh;
  double reach_fh_ = cover_radius_fh;
};

}  // namespace telehug
