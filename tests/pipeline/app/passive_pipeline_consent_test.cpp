// SPDX-License-Identifier: Apache-2.0
#include "doubles/allocation_counter.hpp"
#include "pipeline/app/passive_pipeline_fixture.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The wearer wants less than everything.
class PassivePipelineWithConsent : public PassivePipelineTest {
 protected:
  void mute(int box) {
    Permission permission;
    permission.muted_boxes.set(static_cast<std::size_t>(box));
    safety.permit(permission, clock.now());
    pipeline.forget_touches(clock.now());
  }
  const FeltAnswers& touch_both(Phase phase) {
    event = event_of(event.sequence + 1, {contact_in(1, 1, phase), contact_in(2, 2, phase)});
    event.session = session;
    event.sent_time_ns = to_ns(clock.now());
    return pipeline.process(event, clock.now());
  }
};

TEST_F(PassivePipelineWithConsent, AnswersThatItIsPausedOrQuietUntilItIsNot) {
  Permission permission;
  for (const FeltOutcome why : {FeltOutcome::paused, FeltOutcome::quiet_hours}) {
    permission.refusal = why;
    safety.permit(permission, clock.now());
    EXPECT_EQ(touch(2, Phase::move).at(0).outcome, why);
    EXPECT_THAT(touch(2, Phase::move), IsEmpty());
    EXPECT_THAT(running(), IsEmpty());
  }
  safety.permit({}, clock.now());
  EXPECT_EQ(touch(2, Phase::move).at(0).outcome, FeltOutcome::driven);
  EXPECT_THAT(running(), ElementsAre(1, 2));
}

TEST_F(PassivePipelineWithConsent, FeelsNothingOfAMutedBoxAndSaysSoForThatContactAlone) {
  mute(2);
  const FeltAnswers& answers = touch_both(Phase::down);
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].contact_id, 1U);
  EXPECT_EQ(answers[0].outcome, FeltOutcome::driven);
  EXPECT_EQ(answers[1].contact_id, 2U);
  EXPECT_EQ(answers[1].box, 2);
  EXPECT_EQ(answers[1].touch_sequence, 1U);
  EXPECT_EQ(answers[1].outcome, FeltOutcome::muted);
  EXPECT_THAT(answers[1].actuators, IsEmpty());
  EXPECT_THAT(running(), ElementsAre(0));
  EXPECT_THAT(touch_both(Phase::move), IsEmpty()) << "no news";
}

TEST_F(PassivePipelineWithConsent, EndsWhatRunsInABoxThatIsMutedAtOnce) {
  touch(2);
  ASSERT_THAT(running(), ElementsAre(1, 2));
  mute(2);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(touch(2, Phase::move).at(0).outcome, FeltOutcome::muted);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineWithConsent, FeelsAStrokeOnlyWhereItIsNotMuted) {
  mute(2);
  touch(1);
  EXPECT_EQ(touch(2, Phase::move).at(0).outcome, FeltOutcome::muted);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_EQ(touch(3, Phase::move).at(0).outcome, FeltOutcome::driven);
  EXPECT_THAT(running(), ElementsAre(2));
  EXPECT_EQ(touch(2, Phase::up).at(0).outcome, FeltOutcome::muted);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineWithConsent, FeelsNoLateTapOnAMutedBox) {
  event.sequence = 1;
  touch(std::nullopt);
  mute(2);
  TouchEvent late = event_of(5, {});
  late.session = session;
  late.sent_time_ns = to_ns(clock.now());
  late.transitions = {transition_of(3, contact_in(2)), transition_of(4, contact_in(2, 1, Phase::up))};
  const FeltAnswers& answers = pipeline.process(late, clock.now());
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].outcome, FeltOutcome::muted);
  EXPECT_EQ(answers[0].phase, Phase::down);
  EXPECT_EQ(answers[0].touch_sequence, 3U);
  EXPECT_EQ(answers[1].phase, Phase::up);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineWithConsent, AnswersADownInAMutedBoxOnceThoughTheEventRepeatsIt) {
  mute(2);
  EXPECT_EQ(touch(2).size(), 1U);
}

TEST_F(PassivePipelineWithConsent, IsToldByAMutedActuatorAlone) {
  Permission permission;
  permission.muted_actuators.set(1);
  safety.permit(permission, clock.now());
  EXPECT_EQ(touch(1).at(0).outcome, FeltOutcome::muted);
  EXPECT_THAT(running(), IsEmpty());
  permission.muted_actuators.set(2);
  safety.permit(permission, clock.now());
  EXPECT_EQ(touch(2, Phase::move).at(0).outcome, FeltOutcome::driven) << "actuator 3 serves it, too";
  EXPECT_THAT(running(), ElementsAre(2));
}

TEST_F(PassivePipelineWithConsent, AllocatesNothingWhileAContactOfTwoIsMuted) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  SafetyStage stage(std::make_unique<ForgetfulLink>(), profile, SafetyLimits{});
  PassivePipeline path(0, profile, stage, turn, 200ms, other_session, clock, metrics);
  Permission permission;
  permission.muted_boxes.set(2);
  stage.permit(permission, clock.now());
  event = event_of(1, {contact_in(1, 1, Phase::move), contact_in(2, 2, Phase::move)});
  event.session = session;
  const auto feel = [&] {
    clock.advance(33ms);
    stage.on_heartbeat(0, clock.now());
    stage.tick(clock.now());
    ++event.sequence;
    event.sent_time_ns = to_ns(clock.now());
    path.process(event, clock.now());
  };
  feel();
  feel();
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 200; ++i)
    feel();
  EXPECT_EQ(allocation_count() - before, 0U);
  EXPECT_GT(stage.counters().drives_accepted, 200U);
}

}  // namespace
}  // namespace telehug
