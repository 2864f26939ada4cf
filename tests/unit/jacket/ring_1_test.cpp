// SPDX-License-Identifier: Apache-2.0
//
// Golden test of the shipped ring for the one who touches: answers in, exact bytes out.
#include <gtest/gtest.h>

#include "feedback/felt_pulse.hpp"
#include "unit/jacket/wired_jacket.hpp"

namespace telehug {
namespace {

Felt felt(Phase phase) {
  Felt made;
  made.outcome = FeltOutcome::driven;
  made.phase = phase;
  return made;
}

TEST(Ring1, SaysAPulseForATouchThatBeginsAndALighterOneForOneThatMovesInTheseBytes) {
  WiredJacket ring("ring-1.toml");
  ring.drive(felt_pulse(felt(Phase::down), ring.profile, 0.6, ring.now).value());
  ring.pass(300ms);
  ring.drive(felt_pulse(felt(Phase::move), ring.profile, 0.6, ring.now).value());
  ring.pass(300ms);
  EXPECT_EQ(ring.log,
            "0: 03 10 06 05 7b 0c e0 27 00\n"
            "50: 03 10 07 05 7b 07 3f e0 00\n"
            "100: 03 10 08 05 7b 02 74 64 00\n"
            "300: 03 10 0b 05 73 08 4b d7 00\n"
            "350: 03 10 0c 05 73 03 0d 37 00\n");
}

}  // namespace
}  // namespace telehug
