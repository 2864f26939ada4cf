// SPDX-License-Identifier: Apache-2.0
#include "pipeline/app/passive_pipeline_fixture.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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

}  // namespace
}  // namespace telehug
