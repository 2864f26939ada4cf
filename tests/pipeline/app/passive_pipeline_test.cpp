// SPDX-License-Identifier: Apache-2.0
//
// From a touch event to the commands for the jacket and the answers to the sender.
#include "doubles/allocation_counter.hpp"
#include "pipeline/app/passive_pipeline_fixture.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(PassivePipelineTest, DrivesTheActuatorsOfTheBoxAndSaysSo) {
  const FeltAnswers& answers = touch(2);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].outcome, FeltOutcome::driven);
  EXPECT_EQ(answers[0].session, other_session);
  EXPECT_EQ(answers[0].touch_session, example_session);
  EXPECT_EQ(answers[0].touch_sequence, 1U);
  EXPECT_EQ(answers[0].contact_id, 1U);
  EXPECT_EQ(answers[0].phase, Phase::down);
  EXPECT_EQ(answers[0].box, 2);
  EXPECT_THAT(answers[0].actuators, ElementsAre(2, 3));
  EXPECT_EQ(answers[0].received_time_ns, to_ns(clock.now()));
  EXPECT_EQ(answers[0].driven_time_ns, to_ns(clock.now()));
  EXPECT_THAT(running(), ElementsAre(1, 2));
}

TEST_F(PassivePipelineTest, AnswersOnlyNews) {
  EXPECT_EQ(touch(2).size(), 1U);
  EXPECT_THAT(touch(2, Phase::move), IsEmpty());
  EXPECT_THAT(touch(2, Phase::move), IsEmpty());
  const FeltAnswers& moved = touch(1, Phase::move);
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].box, 1);
  EXPECT_THAT(running(), ElementsAre(0));
  const FeltAnswers& ended = touch(1, Phase::up);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].phase, Phase::up);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineTest, KnowsWhatTheLastTouchWas) {
  Contact contact = contact_in(2, 1, Phase::down);
  touch(contact);
  EXPECT_EQ(pipeline.last_gesture(), Gesture::none);
  contact.phase = Phase::up;
  contact.gesture = Gesture::pat;
  touch(contact);
  EXPECT_EQ(pipeline.last_gesture(), Gesture::pat);
  touch(std::nullopt);
  EXPECT_EQ(pipeline.last_gesture(), Gesture::pat);
}

TEST_F(PassivePipelineTest, EndsADriveThatIsNotRenewed) {
  touch(2);
  pass(150ms);
  EXPECT_THAT(running(), ElementsAre(1, 2));
  pass(60ms);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineTest, AnswersStaleWhenTheSenderIsSilent) {
  pass(260ms);
  const FeltAnswers& answers = touch(2);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].outcome, FeltOutcome::stale);
  EXPECT_THAT(answers[0].actuators, IsEmpty());
  EXPECT_EQ(answers[0].driven_time_ns, 0);
  EXPECT_THAT(running(), IsEmpty());
  beat();
  EXPECT_EQ(touch(2, Phase::move).at(0).outcome, FeltOutcome::driven) << "felt otherwise than before: news";
}

TEST_F(PassivePipelineTest, AnswersStaleWhenTheEventIsLate) {
  const FeltAnswers& answers = touch(contact_in(2), 200ms);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].outcome, FeltOutcome::stale);
  EXPECT_EQ(answers[0].phase, Phase::down);
  EXPECT_EQ(counter("events_stale"), 1U);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineTest, AnswersStoppedUntilResumed) {
  safety.stop("enough", clock.now());
  EXPECT_EQ(touch(2).at(0).outcome, FeltOutcome::stopped);
  EXPECT_THAT(touch(2, Phase::move), IsEmpty());
  EXPECT_THAT(running(), IsEmpty());
  safety.resume();
  const FeltAnswers& answers = touch(2, Phase::move);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].outcome, FeltOutcome::driven);
  EXPECT_THAT(running(), ElementsAre(1, 2));
}

TEST_F(PassivePipelineTest, AnswersThatNoJacketIsThereUntilOneIs) {
  jacket.next_state = LinkState::absent;
  pass(10ms);
  EXPECT_EQ(touch(2).at(0).outcome, FeltOutcome::jacket_absent);
  EXPECT_THAT(touch(2, Phase::move), IsEmpty());
  jacket.next_state = LinkState::armed;
  pass(10ms);
  EXPECT_EQ(touch(2, Phase::move).at(0).outcome, FeltOutcome::driven);
  EXPECT_THAT(running(), ElementsAre(1, 2));
}

TEST_F(PassivePipelineTest, AnswersThatABoxIsUncovered) {
  EXPECT_EQ(touch(5).at(0).outcome, FeltOutcome::uncovered);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineTest, DropsADoubledAndAnOvertakenEvent) {
  touch(2);
  const TouchEvent first = event;
  EXPECT_THAT(pipeline.process(first, clock.now()), IsEmpty());
  touch(2, Phase::up);
  EXPECT_THAT(pipeline.process(first, clock.now()), IsEmpty());
  EXPECT_THAT(running(), IsEmpty()) << "an old down starts nothing";
  EXPECT_EQ(counter("events_doubled"), 2U);
}

TEST_F(PassivePipelineTest, FeelsATapWhoseOwnEventsWereLost) {
  event.sequence = 1;
  touch(std::nullopt);
  TouchEvent late = event_of(5, {});
  late.session = session;
  late.sent_time_ns = to_ns(clock.now());
  late.transitions = {transition_of(3, contact_in(2)), transition_of(4, contact_in(2, 1, Phase::up))};
  const FeltAnswers& answers = pipeline.process(late, clock.now());
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].phase, Phase::down);
  EXPECT_EQ(answers[0].touch_sequence, 3U);
  EXPECT_EQ(answers[0].outcome, FeltOutcome::driven);
  EXPECT_THAT(running(), ElementsAre(1, 2));
  EXPECT_EQ(counter("transitions_recovered"), 2U);
}

TEST_F(PassivePipelineTest, TurnsEverythingOffWhenTheSenderIsReplaced) {
  touch(2);
  ASSERT_THAT(running(), ElementsAre(1, 2));
  session = "00000000000000000000000000000001";
  event.sequence = 0;
  touch(std::nullopt);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineTest, AllocatesNothingWhileAContactGoesOn) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  auto link = std::make_unique<ForgetfulLink>();
  const ForgetfulLink& jacket_link = *link;
  SafetyStage stage(std::move(link), profile, SafetyLimits{});
  PassivePipeline path(0, profile, stage, turn, 200ms, other_session, clock, metrics);
  event = event_of(1, {contact_in(2)});
  event.session = session;
  std::size_t answers = 0;
  const auto feel = [&] {
    clock.advance(33ms);
    stage.on_heartbeat(0, clock.now());
    stage.tick(clock.now());
    ++event.sequence;
    event.sent_time_ns = to_ns(clock.now());
    answers += path.process(event, clock.now()).size();
  };
  feel();
  event.contacts[0].phase = Phase::move;
  feel();
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 200; ++i)
    feel();
  EXPECT_EQ(allocation_count() - before, 0U);
  EXPECT_EQ(answers, 1U);
  EXPECT_GT(jacket_link.sent(), 200U) << "it was renewed all the time";
}

TEST_F(PassivePipelineTest, AnswersAContactOfANewSessionThatResemblesOneOfTheOld) {
  ASSERT_EQ(touch(2).size(), 1U);
  EXPECT_THAT(touch(2, Phase::move), IsEmpty());
  session = "00000000000000000000000000000abc";
  event.sequence = 0;
  EXPECT_EQ(touch(2, Phase::move).size(), 1U);  // its down was lost long ago
}

}  // namespace
}  // namespace telehug
