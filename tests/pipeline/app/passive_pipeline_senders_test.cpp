// SPDX-License-Identifier: Apache-2.0
#include "pipeline/app/passive_pipeline_fixture.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;

// Another sender to the same jacket.
class TwoSenders : public PassivePipelineTest {
 protected:
  void let_touch(bool one_at_a_time) {
    turn = SenderTurn(one_at_a_time);
    safety.on_heartbeat(1, clock.now());
    Heartbeat heartbeat = example_heartbeat();
    heartbeat.session = other_session;
    heartbeat.sent_time_ns = to_ns(clock.now());
    other.observe(heartbeat, clock.now());
  }
  FeltOutcome other_touches(int box) {
    ++sequence;
    TouchEvent touched = event_of(sequence, {contact_in(box, 9, sequence == 1 ? Phase::down : Phase::move)});
    touched.session = other_session;
    touched.sent_time_ns = to_ns(clock.now());
    if (sequence == 1) touched.transitions.push_back(transition_of(1, touched.contacts[0]));
    const FeltAnswers& answers = other.process(touched, clock.now());
    return answers.empty() ? FeltOutcome::uncovered : answers.at(0).outcome;
  }

  std::uint64_t sequence = 0;
  PassivePipeline other{1, profile, safety, turn, 200ms, other_session, clock, metrics};
};

TEST_F(TwoSenders, AreFeltTogetherIfMerged) {
  let_touch(false);
  EXPECT_EQ(touch(1).at(0).outcome, FeltOutcome::driven);
  EXPECT_EQ(other_touches(2), FeltOutcome::driven);
  EXPECT_THAT(running(), ElementsAre(0, 1, 2));
  EXPECT_EQ(counter("events_accepted"), 2U);
}

TEST_F(TwoSenders, AreFeltOneAtATimeIfExclusiveAndTheOtherIsToldWhy) {
  let_touch(true);
  EXPECT_EQ(touch(1).at(0).outcome, FeltOutcome::driven);
  EXPECT_EQ(other_touches(2), FeltOutcome::another_sender);
  EXPECT_THAT(running(), ElementsAre(0));
  for (Duration passed{}; passed < SenderTurn::pause; passed += 100ms) {
    pass(100ms);
    safety.on_heartbeat(1, clock.now());
  }
  EXPECT_EQ(other_touches(2), FeltOutcome::driven);  // it has rested there all the time
  EXPECT_THAT(running(), ElementsAre(1, 2));
}

}  // namespace
}  // namespace telehug
