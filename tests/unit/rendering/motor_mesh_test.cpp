// SPDX-License-Identifier: Apache-2.0
#include "rendering/motor_mesh.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "jacket/load_jacket_profile.hpp"
#include "rendering/geometry.hpp"
#include "rendering/triangulation.hpp"
#include "unit/rendering/rendering_builders.hpp"

namespace telehug {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

MATCHER_P2(IsShare, index, amplitude, "") {
  return arg.index == static_cast<std::size_t>(index) && std::abs(arg.amplitude - amplitude) < 1e-9;
}

double energy(const Spot& spot) {
  return std::accumulate(spot.begin(), spot.end(), 0.0,
                         [](double sum, const SpotShare& share) { return sum + share.amplitude * share.amplitude; });
}

BodyPoint centre(const Spot& spot, const JacketProfile& profile) {
  BodyPoint sum;
  for (const auto& [index, amplitude] : spot) {
    sum.x_fh += amplitude * amplitude * profile.actuators[index].place.x_fh / energy(spot);
    sum.y_fh += amplitude * amplitude * profile.actuators[index].place.y_fh / energy(spot);
  }
  return sum;
}

std::vector<double> energies(const Spot& spot, std::size_t motors) {
  std::vector<double> all(motors);
  for (const auto& [index, amplitude] : spot)
    all.at(index) += amplitude * amplitude;
  return all;
}

JacketProfile shipped() {
  auto profile = load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml");
  if (!profile) throw std::runtime_error(profile.error().message);
  return std::move(profile).value();
}

JacketProfile random_motors(std::mt19937& random, Uncovered uncovered) {
  std::uniform_int_distribution<int> count(1, static_cast<int>(max_actuators));
  std::uniform_real_distribution<double> across(-1.25, 1.25);
  std::uniform_real_distribution<double> down(0, 2);
  std::vector<Actuator> motors;
  for (int id = count(random); id > 0; --id)
    motors.push_back(motor(static_cast<std::uint8_t>(id), {across(random), down(random)}, {}));
  return places_of(std::move(motors), uncovered);
}

TEST(MotorMesh, shares_a_touch_between_two_motors_by_the_energy_model) {
  const JacketProfile profile = places_of({motor(1, {0, 1}, {}), motor(2, {0.4, 1}, {})});
  const MotorMesh mesh(profile, BodySide::front);
  EXPECT_THAT(mesh.at({0, 1}), ElementsAre(IsShare(0, 1.0)));
  EXPECT_THAT(mesh.at({0.1, 1}), UnorderedElementsAre(IsShare(0, std::sqrt(0.75)), IsShare(1, std::sqrt(0.25))));
  EXPECT_THAT(mesh.at({0.2, 1}), UnorderedElementsAre(IsShare(0, std::sqrt(0.5)), IsShare(1, std::sqrt(0.5))));
  EXPECT_THAT(mesh.at({0.4, 1}), ElementsAre(IsShare(1, 1.0)));
}

TEST(MotorMesh, feels_a_touch_between_motors_where_it_is_with_all_its_energy) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-1.5, 1.5);
  std::uniform_real_distribution<double> down(-0.5, 2.5);
  int inside = 0;
  for (int jacket = 0; jacket < 60; ++jacket) {
    const JacketProfile profile = jacket == 0 ? shipped() : random_motors(random, Uncovered::nearest);
    const MotorMesh mesh(profile, BodySide::front);
    for (int touch = 0; touch < 200; ++touch) {
      const BodyPoint place{across(random), down(random)};
      const Spot spot = mesh.at(place);
      EXPECT_NEAR(energy(spot), 1, 1e-9);
      for (const SpotShare& share : spot)
        EXPECT_TRUE(share.amplitude > 0 && share.amplitude <= 1) << share.amplitude;
      if (!mesh.inside(place)) continue;
      ++inside;
      // Motors that are too near to each other to be told apart count as one.
      EXPECT_LT(distance_fh(centre(spot, profile), place), jacket == 0 ? 1e-9 : least_distance_fh);
    }
  }
  EXPECT_GT(inside, 3000);
}

// Of no point is it only nearly known whether it lies between motors: the triangles fill the hull.
TEST(MotorMesh, fills_the_whole_hull_of_its_motors) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> part(0, 1);
  for (int jacket = 0; jacket < 60; ++jacket) {
    const JacketProfile profile = random_motors(random, Uncovered::none);
    if (profile.actuators.size() < 3) continue;
    const MotorMesh mesh(profile, BodySide::front);
    std::uniform_int_distribution<std::size_t> any(0, profile.actuators.size() - 1);
    for (int touch = 0; touch < 100; ++touch) {
      const BodyPoint a = profile.actuators[any(random)].place;
      const BodyPoint b = profile.actuators[any(random)].place;
      const BodyPoint c = profile.actuators[any(random)].place;
      const BodyPoint place = point_between(point_between(a, b, part(random)), c, part(random));
      EXPECT_LT(distance_fh(centre(mesh.at(place), profile), place), 1.5 * least_distance_fh)
          << place.x_fh << ", " << place.y_fh;
    }
  }
}

TEST(MotorMesh, changes_little_where_a_finger_moves_little) {
  std::mt19937 random(3);
  const JacketProfile profile = shipped();
  JacketProfile anywhere = profile;
  anywhere.uncovered = Uncovered::nearest;
  const MotorMesh mesh(anywhere, BodySide::front);
  std::uniform_real_distribution<double> across(-2, 2);
  std::uniform_real_distribution<double> down(-1, 3);
  constexpr double step_fh = 0.001;
  constexpr double least_height_fh = 0.2;  // of any triangle of this jacket: a weight falls from 1 to 0 over it
  for (int way = 0; way < 100; ++way) {
    const BodyPoint from{across(random), down(random)};
    const BodyPoint to{across(random), down(random)};
    const int steps = static_cast<int>(distance_fh(from, to) / step_fh) + 1;
    auto before = energies(mesh.at(from), profile.actuators.size());
    for (int i = 1; i <= steps; ++i) {
      const auto now =
          energies(mesh.at(point_between(from, to, static_cast<double>(i) / steps)), profile.actuators.size());
      for (std::size_t motor = 0; motor < now.size(); ++motor)
        EXPECT_THAT(now[motor], DoubleNear(before[motor], step_fh / least_height_fh));
      before = now;
    }
  }
}

TEST(MotorMesh, feels_a_place_outside_at_the_nearest_one_if_the_profile_says_so) {
  const JacketProfile nearest = places_of(row_of_motors(), Uncovered::nearest);
  const MotorMesh mesh(nearest, BodySide::front);
  EXPECT_THAT(mesh.at({-90, 90}), ElementsAre(IsShare(0, 1.0)));
  EXPECT_THAT(mesh.at({0.25, 3}), UnorderedElementsAre(IsShare(2, std::sqrt(0.5)), IsShare(3, std::sqrt(0.5))));
}

TEST(MotorMesh, covers_half_a_box_around_its_motors_otherwise) {
  const JacketProfile none = places_of(row_of_motors(), Uncovered::none);
  const MotorMesh mesh(none, BodySide::front);
  EXPECT_THAT(mesh.at({0, 1 + cover_radius_fh - 0.01}), ElementsAre(IsShare(2, 1.0)));
  EXPECT_THAT(mesh.at({0, 1 + cover_radius_fh + 0.01}), IsEmpty());
  EXPECT_THAT(mesh.at({-1 - cover_radius_fh - 0.01, 1}), IsEmpty());
}

TEST(MotorMesh, feels_nothing_at_what_is_no_place) {
  const JacketProfile nearest = places_of(row_of_motors(), Uncovered::nearest);
  const MotorMesh mesh(nearest, BodySide::front);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const BodyPoint place :
       {BodyPoint{nan, 1}, BodyPoint{0, nan}, BodyPoint{infinity, 1}, BodyPoint{0, -infinity}}) {
    EXPECT_THAT(mesh.at(place), IsEmpty());
    EXPECT_FALSE(mesh.inside(place));
  }
  EXPECT_THAT(mesh.at({1e300, -1e300}), ElementsAre(IsShare(4, 1.0)));
}

TEST(MotorMesh, makes_do_with_one_motor_or_none) {
  const JacketProfile one = places_of({motor(1, {0, 1}, {})});
  EXPECT_THAT(MotorMesh(one, BodySide::front).at({0.1, 1.1}), ElementsAre(IsShare(0, 1.0)));
  EXPECT_THAT(MotorMesh(one, BodySide::front).at({0.3, 1.3}), IsEmpty());
  EXPECT_TRUE(MotorMesh(one, BodySide::back).empty());
  EXPECT_THAT(MotorMesh(one, BodySide::back).at({0, 1}), IsEmpty());
}

TEST(MotorMesh, lets_motors_at_one_place_share_equally) {
  const JacketProfile profile =
      places_of({motor(1, {0, 1}, {}), motor(2, {0.5, 1}, {}), motor(3, {0, 1}, {}), motor(4, {0, 1}, {})});
  const MotorMesh mesh(profile, BodySide::front);
  const double third = std::sqrt(1 / 3.0);
  EXPECT_THAT(mesh.at({0, 1}), ElementsAre(IsShare(0, third), IsShare(2, third), IsShare(3, third)));
  EXPECT_NEAR(energy(mesh.at({0.2, 1})), 1, 1e-12);
}

TEST(MotorMesh, knows_motors_on_one_line_by_their_neighbours_alone) {
  const JacketProfile profile =
      places_of({motor(1, {0, 0}, {}), motor(2, {0.3, 0.3}, {}), motor(3, {0.6, 0.6}, {}), motor(4, {0.9, 0.9}, {})});
  const MotorMesh mesh(profile, BodySide::front);
  EXPECT_THAT(mesh.at({0.45, 0.45}), UnorderedElementsAre(IsShare(1, std::sqrt(0.5)), IsShare(2, std::sqrt(0.5))));
  EXPECT_NEAR(mesh.pitch_fh(), std::hypot(0.3, 0.3), 1e-12);
}

TEST(MotorMesh, lets_the_neighbours_take_over_from_a_motor_that_is_off) {
  JacketProfile profile = places_of(row_of_motors());
  profile.actuators[2].enabled = false;
  EXPECT_THAT(MotorMesh(profile, BodySide::front).at({0, 1}),
              UnorderedElementsAre(IsShare(1, std::sqrt(0.5)), IsShare(3, std::sqrt(0.5))));
  profile.actuators[1].max_strength = 0;
  EXPECT_THAT(MotorMesh(profile, BodySide::front).at({0, 1}),
              UnorderedElementsAre(IsShare(0, std::sqrt(1 / 3.0)), IsShare(3, std::sqrt(2 / 3.0))));
}

TEST(MotorMesh, holds_neither_heaters_nor_the_other_side) {
  JacketProfile profile = places_of(row_of_motors());
  profile.actuators[1].kind = ActuatorKind::heater;
  profile.actuators[2].side = BodySide::back;
  EXPECT_THAT(MotorMesh(profile, BodySide::front).at({-0.5, 1}),
              UnorderedElementsAre(IsShare(0, std::sqrt(2 / 3.0)), IsShare(3, std::sqrt(1 / 3.0))));
  EXPECT_THAT(MotorMesh(profile, BodySide::back).at({0, 1}), ElementsAre(IsShare(2, 1.0)));
}

TEST(MotorMesh, knows_which_motors_a_way_leads_past) {
  const JacketProfile profile = places_of(row_of_motors());
  const MotorMesh mesh(profile, BodySide::front);
  EXPECT_THAT(mesh.passed({-0.7, 1}, {0.4, 1}), ElementsAre(IsShare(1, 1.0), IsShare(2, 1.0)));
  EXPECT_THAT(mesh.passed({-0.7, 1.1}, {-0.2, 1.1}), ElementsAre(IsShare(1, 1.0)));
  EXPECT_THAT(mesh.passed({-0.7, 1}, {-0.5, 1}), ElementsAre(IsShare(1, 1.0))) << "reached";
  EXPECT_THAT(mesh.passed({-0.5, 1}, {-0.3, 1}), IsEmpty()) << "left";
  EXPECT_THAT(mesh.passed({-0.5, 1}, {-0.5, 1}), IsEmpty()) << "at rest";
  EXPECT_THAT(mesh.passed({-0.7, 3}, {0.4, 3}), IsEmpty()) << "far away";
}

TEST(Triangulation, joins_the_nearest_and_crosses_nothing) {
  const std::vector<BodyPoint> kite{{0, 0}, {1, 0.3}, {2, 0}, {1, -0.3}};
  const Triangulation made = triangulate(kite);
  EXPECT_THAT(made.edges, ::testing::Contains(std::array<std::size_t, 2>{1, 3}));
  EXPECT_THAT(made.edges, ::testing::Not(::testing::Contains(std::array<std::size_t, 2>{0, 2})));
  EXPECT_THAT(made.triangles,
              UnorderedElementsAre(std::array<std::size_t, 3>{0, 1, 3}, std::array<std::size_t, 3>{1, 2, 3}));
}

TEST(Triangulation, splits_the_squares_of_a_grid_each_once) {
  std::vector<BodyPoint> grid;
  for (int i = 0; i < 12; ++i)
    grid.push_back({i % 4 * 0.5, i / 4 * 0.5});
  EXPECT_EQ(triangulate(grid).triangles.size(), 12U);
}

TEST(Triangulation, leaves_no_node_inside_of_a_triangle) {
  const std::vector<BodyPoint> star{{0, 0}, {1, 0}, {0.5, 1}, {0.5, 0.3}};
  const Triangulation made = triangulate(star);
  EXPECT_EQ(made.edges.size(), 6U);
  EXPECT_EQ(made.triangles.size(), 3U);
}

TEST(Triangulation, has_no_triangles_of_fewer_than_three_nodes_or_of_nodes_on_a_line) {
  EXPECT_THAT(triangulate({}).edges, IsEmpty());
  EXPECT_THAT(triangulate(std::vector<BodyPoint>{{0, 0}}).edges, IsEmpty());
  EXPECT_EQ(triangulate(std::vector<BodyPoint>{{0, 0}, {1, 1}}).edges.size(), 1U);
  const Triangulation line = triangulate(std::vector<BodyPoint>{{0, 0}, {1, 1}, {0.5, 0.5}});
  EXPECT_THAT(line.triangles, IsEmpty());
  EXPECT_EQ(line.edges.size(), 2U);
}

}  // namespace
}  // namespace telehug
