// SPDX-License-Identifier: Apache-2.0
//
// From a touch event to the commands for the jacket and the answers to the sender.
#include "passive_pipeline.hpp"

#include <gmock/gmock.h>

#include "doubles/allocation_counter.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"
#include "doubles/fake_jacket_link.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class PassivePipelineTest : public testing::Test {
 protected:
  PassivePipelineTest() {
    safety.tick(clock.now());
    beat();
  }

  // The sender's heartbeat, without any delay.
  void beat() {
    Heartbeat heartbeat = example_heartbeat();
    heartbeat.sent_time_ns = to_ns(clock.now());
    safety.on_heartbeat(0, clock.now());
    pipeline.observe(heartbeat, clock.now());
  }

  // The sender's next event, with this contact if any; its way takes `delay`.
  const FeltAnswers& touch(std::optional<Contact> contact, Duration delay = {}) {
    event = event_of(event.sequence + 1, {});
    event.session = session;
    event.sent_time_ns = to_ns(clock.now());
    if (contact) {
      event.contacts.push_back(*contact);
      if (contact->phase != Phase::move) event.transitions.push_back(transition_of(event.sequence, *contact));
    }
    clock.advance(delay);
    if (delay > Duration{}) safety.on_heartbeat(0, clock.now());
    return pipeline.process(event, clock.now());
  }
  const FeltAnswers& touch(int box, Phase phase = Phase::down) { return touch(contact_in(box, 1, phase)); }
  void pass(Duration time) {
    clock.advance(time);
    pipeline.tick(clock.now());
    safety.tick(clock.now());
  }
  [[nodiscard]] std::vector<int> running() const { return jacket.running(clock.now()); }
  std::uint64_t counter(const char* name) { return metrics.counter(name).value(); }

  FakeClock clock;
  FakeJacket jacket;
  MetricsRegistry metrics;
  JacketProfile profile = profile_of({motor(1, {}, {1}), motor(2, {}, {2}), motor(3, {}, {2, 3})});
  SafetyStage safety{std::make_unique<FakeJacketLink>(jacket), profile, SafetyLimits{}};
  SenderTurn turn{false};
  PassivePipeline pipeline{0, profile, safety, turn, 200ms, other_session, clock, metrics};
  SessionId session = example_session;
  TouchEvent event;
};

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

// Takes everything and remembers nothing.
class ForgetfulLink final : public JacketLink {
 public:
  void poll(Timestamp) override {}
  bool send(const MotorCommands& commands, Timestamp) override {
    sent_ += commands.size();
    return true;
  }
  bool heat(const HeaterCommands&, Timestamp) override { return false; }
  void stop_all(Timestamp) override {}
  [[nodiscard]] const LinkStatus& status() const override { return status_; }
  [[nodiscard]] std::size_t sent() const { return sent_; }

 private:
  LinkStatus status_{.state = LinkState::armed, .device = "forgetful", .problem = {}, .motor_count = 16};
  std::size_t sent_ = 0;
};

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

// The same motors, felt by the place of a touch: in a row across the chest.
class PassivePipelineOfPlaces : public PassivePipelineTest {
 protected:
  PassivePipelineOfPlaces() {
    profile.rendering = Rendering::places;
    for (int i = 0; i < 3; ++i)
      profile.actuators[static_cast<std::size_t>(i)].place = {(i - 1) * 0.5, 0.25};
    places.emplace(SenderNumber{0}, profile, safety, turn, 200ms, other_session, clock, metrics);
  }

  const FeltAnswers& feel(Contact contact) {
    event = event_of(event.sequence + 1, {contact});
    event.session = session;
    event.sent_time_ns = to_ns(clock.now());
    if (contact.phase != Phase::move) event.transitions.push_back(transition_of(event.sequence, contact));
    return places->process(event, clock.now());
  }
  void go_on(Duration time) {
    for (Duration passed{}; passed < time; passed += 10ms) {
      clock.advance(10ms);
      safety.on_heartbeat(0, clock.now());
      places->tick(clock.now());
      safety.tick(clock.now());
    }
  }

  std::optional<PassivePipeline> places;
};

TEST_F(PassivePipelineOfPlaces, FeelsATapForAsLongAsItTakesAMotorToBeFelt) {
  EXPECT_THAT(feel(contact_in(3)).at(0).actuators, ElementsAre(2));
  EXPECT_THAT(running(), ElementsAre(1));
  go_on(30ms);
  Contact up = contact_in(3, 1, Phase::up);
  up.gesture = Gesture::tap;
  feel(up);
  go_on(50ms);
  EXPECT_THAT(running(), ElementsAre(1));
  go_on(30ms);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineOfPlaces, LetsAHoldFadeBetweenTwoEvents) {
  Contact hold = contact_in(3, 1, Phase::move);
  hold.gesture = Gesture::hold;
  feel(hold);
  for (int i = 0; i < 8; ++i) {
    go_on(100ms);
    feel(hold);
  }
  const int before = jacket.intensity(1, clock.now());
  go_on(150ms);
  EXPECT_LT(jacket.intensity(1, clock.now()), before);
  go_on(60ms);
  EXPECT_THAT(running(), IsEmpty()) << "no event vouches for it any more";
}

TEST_F(PassivePipelineOfPlaces, FeelsATouchBesideAMutedBoxByItsOtherNeighbourAloneAndSaysSo) {
  SafetyStage stage(std::make_unique<FakeJacketLink>(jacket), profile, SafetyLimits{});
  PassivePipeline path(0, profile, stage, turn, 200ms, other_session, clock, metrics);
  stage.tick(clock.now());
  Contact between = contact_in(2);
  between.body = {-0.3, 0.25};
  const auto feel_with = [&](const Permission& permission) -> Felt {
    stage.permit(permission, clock.now());
    path.forget_touches(clock.now());
    stage.on_heartbeat(0, clock.now());
    event = event_of(event.sequence + 1, {between});
    event.session = session;
    event.sent_time_ns = to_ns(clock.now());
    return path.process(event, clock.now()).at(0);
  };
  EXPECT_THAT(feel_with({}).actuators, ElementsAre(1, 2));
  EXPECT_THAT(running(), ElementsAre(0, 1));
  const int share = jacket.intensity(0, clock.now());

  Permission permission;
  permission.muted_boxes.set(3);
  const Felt beside = feel_with(permission);
  EXPECT_EQ(beside.outcome, FeltOutcome::driven);
  EXPECT_THAT(beside.actuators, ElementsAre(1));
  EXPECT_THAT(running(), ElementsAre(0));
  EXPECT_EQ(jacket.intensity(0, clock.now()), share);

  between.body = {-0.24, 0.25};
  between.box = 3;
  EXPECT_EQ(feel_with(permission).outcome, FeltOutcome::muted) << "the box itself";
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(PassivePipelineOfPlaces, MovesNothingOnItsOwnAfterAStop) {
  feel(contact_in(3));
  safety.stop("enough", clock.now());
  go_on(100ms);
  EXPECT_THAT(running(), IsEmpty());
}

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
