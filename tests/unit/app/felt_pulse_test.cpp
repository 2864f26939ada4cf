// SPDX-License-Identifier: Apache-2.0
#include "feedback/felt_pulse.hpp"

#include <gtest/gtest.h>

#include "jacket/load_jacket_profile.hpp"

namespace telehug {
namespace {

JacketProfile ring() {
  return load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/ring-1.toml").value();
}

Felt answer(FeltOutcome outcome, Phase phase) {
  Felt felt;
  felt.outcome = outcome;
  felt.phase = phase;
  return felt;
}

TEST(FeltPulse, IsFirmForATouchThatBeginsAndLighterForOneThatMoves) {
  const Timestamp now = from_ns(5'000'000'000);
  const auto begins = felt_pulse(answer(FeltOutcome::driven, Phase::down), ring(), 0.5, now);
  const auto moves = felt_pulse(answer(FeltOutcome::driven, Phase::move), ring(), 0.5, now);
  ASSERT_TRUE(begins && moves);
  ASSERT_EQ(begins->size(), 1U);
  EXPECT_EQ(begins->at(0).actuator, 1);
  EXPECT_EQ(begins->at(0).strength, 0.5);
  EXPECT_GT(begins->at(0).strength, moves->at(0).strength);
  EXPECT_GT(begins->at(0).end, moves->at(0).end);
  EXPECT_GE(moves->at(0).end, now + 60ms) << "shorter is not felt";
  EXPECT_LE(begins->at(0).end, now + 250ms);
}

TEST(FeltPulse, SaysNothingOfWhatTheWearerDidNotFeel) {
  for (const FeltOutcome outcome : {FeltOutcome::stopped, FeltOutcome::stale, FeltOutcome::uncovered,
                                    FeltOutcome::jacket_absent, FeltOutcome::limited, FeltOutcome::paused})
    EXPECT_FALSE(felt_pulse(answer(outcome, Phase::down), ring(), 1, from_ns(0)));
  EXPECT_FALSE(felt_pulse(answer(FeltOutcome::driven, Phase::up), ring(), 1, from_ns(0)));
}

TEST(FeltPulse, LeavesOutWhatIsSwitchedOff) {
  JacketProfile profile = ring();
  profile.actuators[0].enabled = false;
  EXPECT_TRUE(felt_pulse(answer(FeltOutcome::driven, Phase::down), profile, 1, from_ns(0))->empty());
}

}  // namespace
}  // namespace telehug
