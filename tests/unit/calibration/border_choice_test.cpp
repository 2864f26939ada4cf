// SPDX-License-Identifier: Apache-2.0
#include "calibration/border_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "doubles/drawn_bezel.hpp"
#include "doubles/random_rig.hpp"

namespace telehug {
namespace {

constexpr ScreenSize screen{380, 300, 0, 0};

double distance_px(const RigCamera& camera, const BorderCandidate& candidate) {
  double sum = 0;
  for (const BorderObservation& point : candidate.points)
    sum += (point.image.v_px - *border_row(camera, screen.height_mm, point.image.u_px)) /
           static_cast<double>(candidate.points.size());
  return sum;
}

class BorderCandidates : public testing::TestWithParam<double> {
 protected:
  KnownRig rig{screen, {RigCamera({1000, GetParam(), {195, -15, 50}, 1, -1, 2}, {1280, 720}), 12}};
  std::vector<BorderCandidate> candidates =
      find_border_candidates(drawn_bezel(rig.model.camera, screen), border_line(rig.model.camera, screen));
};

TEST_P(BorderCandidates, HoldEveryEdgeOfTheBezelAsTheLensBendsIt) {
  for (const double edge : {0.0, -8.0, -11.0, -18.0}) {
    EXPECT_THAT(candidates, testing::Contains(testing::ResultOf(
                                [&](const BorderCandidate& c) { return distance_px(rig.model.camera, c) - edge; },
                                testing::DoubleNear(0, 0.3))))
        << edge;
  }
  for (const BorderCandidate& candidate : candidates) {
    const double level = distance_px(rig.model.camera, candidate);
    double squares = 0;
    for (const BorderObservation& point : candidate.points)
      squares += std::pow(point.image.v_px - level - *border_row(rig.model.camera, 300, point.image.u_px), 2);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(candidate.points.size())), 0.5) << level;
  }
}

TEST_P(BorderCandidates, LetTheTouchesChooseTheScreensOwnEdge) {
  RandomRigs random(61);
  RigObservations seen = random.observe(rig, 9, 0.3, 0.3, false);
  const auto chosen = solve_with_border(seen, candidates);
  ASSERT_TRUE(chosen.ok()) << chosen.error().message;
  ASSERT_TRUE(chosen->chosen.has_value());
  EXPECT_TRUE(chosen->clear);
  EXPECT_NEAR(distance_px(rig.model.camera, candidates[*chosen->chosen]), 0, 0.3);
  EXPECT_EQ(chosen->calibration.observations.border.size(), candidates[*chosen->chosen].points.size());
}

INSTANTIATE_TEST_SUITE_P(Lenses, BorderCandidates, testing::Values(-0.08, 0.0, 0.08));

TEST(BorderChoice, TrustsNoEdgeMuchIfTwoAgreeAlike) {
  RandomRigs random(62);
  const KnownRig rig{screen, {RigCamera({1000, 0.03, {195, -15, 50}, 1, -1, 2}, {1280, 720}), 12}};
  RigObservations seen = random.observe(rig, 2, 0.3, 0.3);
  const BorderCandidate edge{seen.border, false, 5};
  BorderCandidate beside = edge;
  for (BorderObservation& point : beside.points)
    point.image.v_px += 2;
  const auto chosen = solve_with_border(seen, {edge, beside});
  ASSERT_TRUE(chosen.ok());
  EXPECT_FALSE(chosen->clear);
  EXPECT_NEAR(chosen->calibration.observations.border[0].sigma_px, 2, 1e-6);
}

TEST(BorderChoice, TakesNoEdgeThatContradictsTheTouches) {
  RandomRigs random(64);
  for (int i = 0; i < 10; ++i) {
    RigObservations seen = random.observe(random.usual_rig(), 7, 0.3, 0.3);
    BorderCandidate wrong{seen.border, false, 5};
    for (BorderObservation& point : wrong.points)
      point.image.v_px += 10;
    const auto chosen = solve_with_border(seen, {wrong});
    ASSERT_TRUE(chosen.ok());
    EXPECT_FALSE(chosen->chosen.has_value()) << i;
  }
}

TEST(BorderChoice, SolvesWithoutAnyCandidate) {
  RandomRigs random(63);
  const auto chosen = solve_with_border(random.observe(random.rig(), 5, 0.3, 0.3), {});
  ASSERT_TRUE(chosen.ok());
  EXPECT_FALSE(chosen->chosen.has_value());
  EXPECT_TRUE(chosen->calibration.observations.border.empty());
}

}  // namespace
}  // namespace telehug
