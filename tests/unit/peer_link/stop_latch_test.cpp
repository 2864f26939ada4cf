// SPDX-License-Identifier: Apache-2.0
#include "peer_link/stop_latch.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

const SessionId first_run(32, 'a');
const SessionId second_run(32, 'b');

StopAll word(const SessionId& session, std::uint64_t sequence, bool stop) {
  return {.session = session, .side = Side::active, .sequence = sequence, .stop = stop, .reason = ""};
}

class AStopLatch : public testing::Test {
 protected:
  StopLatch latch_;
};

TEST_F(AStopLatch, HoldsAStopUntilItsSenderLiftsIt) {
  EXPECT_FALSE(latch_.stopped());
  latch_.heard(word(first_run, 1, true));
  EXPECT_TRUE(latch_.stopped());
  latch_.heard(word(first_run, 2, false));
  EXPECT_FALSE(latch_.stopped());
}

TEST_F(AStopLatch, LetsARestartedSenderLiftTheStopOfItsEarlierRun) {
  latch_.heard(word(first_run, 5, true));
  latch_.heard(word(second_run, 1, false));
  EXPECT_FALSE(latch_.stopped());
}

TEST_F(AStopLatch, IsNotLiftedByAnEarlierRunOfTheSender) {
  latch_.heard(word(first_run, 1, true));
  latch_.heard(word(second_run, 1, true));
  latch_.heard(word(first_run, 2, false));
  EXPECT_TRUE(latch_.stopped());
}

TEST_F(AStopLatch, IsNotLiftedByAWordThatANewerOneOvertook) {
  latch_.heard(word(first_run, 3, true));
  latch_.heard(word(first_run, 2, false));
  EXPECT_TRUE(latch_.stopped());
}

}  // namespace
}  // namespace telehug
