// SPDX-License-Identifier: Apache-2.0
#include "feedback/felt_drive.hpp"

#include <gmock/gmock.h>

#include "doubles/fake_jacket_link.hpp"
#include "doubles/scripted_opener.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "link/legacy_session.hpp"
#include "link/wire_link.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

JacketProfile ring() {
  return load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/ring-1.toml").value();
}

Felt touch_felt() {
  Felt felt;
  felt.outcome = FeltOutcome::driven;
  felt.phase = Phase::down;
  return felt;
}

// Rounds of the thread.
void live(FeltDrive& drive, Timestamp& now, Duration time) {
  for (Duration passed{}; passed < time; passed += 10ms) {
    now += 10ms;
    drive.tick(now);
  }
}

class FeltDriveTest : public testing::Test {
 protected:
  FeltDriveTest() { live(100ms); }

  void live(Duration time) { telehug::live(drive, now, time); }
  void feel() { drive.feel(touch_felt(), now); }
  [[nodiscard]] std::vector<int> running() const { return jacket.running(now); }

  FakeJacket jacket;
  Timestamp now = from_ns(1'000'000'000);
  FeltDrive drive{ring(), std::make_unique<FakeJacketLink>(jacket), 0.6};
};

TEST_F(FeltDriveTest, PulsesForAnAnswerAndEndsByItself) {
  feel();
  EXPECT_THAT(running(), ElementsAre(0));
  live(60ms);
  EXPECT_THAT(running(), ElementsAre(0));
  live(70ms);
  EXPECT_THAT(running(), IsEmpty());
}

TEST_F(FeltDriveTest, EndsAPulseAtOnceWhenItIsStopped) {
  feel();
  const auto stops = jacket.stops;
  drive.follow_stop(true, now);
  EXPECT_THAT(running(), IsEmpty());
  EXPECT_GT(jacket.stops, stops);
}

TEST_F(FeltDriveTest, DrivesNothingWhileItIsStoppedAndNothingOfThatAfterwards) {
  drive.follow_stop(true, now);
  const auto frames = jacket.frames.size();
  for (int i = 0; i < 10; ++i) {
    feel();
    live(20ms);
  }
  drive.follow_stop(false, now);
  live(200ms);
  EXPECT_EQ(jacket.frames.size(), frames);
  feel();
  EXPECT_THAT(running(), ElementsAre(0)) << "what is felt from now on is";
}

TEST_F(FeltDriveTest, TellsWhatIsMissingUntilItIsThere) {
  EXPECT_EQ(drive.problem(), "");
  jacket.status.problem = "plug it in";
  jacket.next_state = LinkState::absent;
  live(10ms);
  EXPECT_EQ(drive.problem(), "fake: plug it in");
  feel();
  EXPECT_THAT(running(), IsEmpty());
  jacket.next_state = LinkState::armed;
  live(20ms);
  EXPECT_EQ(drive.problem(), "");
}

TEST(FeltDriveOfALegacyActuator, SaysItsNumberForAPulseAndNothingWhileItIsStopped) {
  JacketProfile profile = ring();
  profile.protocol = JacketProtocol::legacy;
  FarEnd far;
  FeltDrive drive(profile,
                  std::make_unique<WireLink>(std::make_unique<ScriptedOpener>(far), std::make_unique<LegacySession>()),
                  0.6);
  Timestamp now = from_ns(1'000'000'000);
  live(drive, now, LegacySession::boot_time + 50ms);
  ASSERT_EQ(drive.problem(), "");
  drive.feel(touch_felt(), now);
  live(drive, now, 500ms);
  EXPECT_THAT(far.wire->read(), ElementsAre(1)) << "one pulse, which ends by itself";
  drive.follow_stop(true, now);
  drive.feel(touch_felt(), now);
  live(drive, now, 500ms);
  EXPECT_THAT(far.wire->read(), IsEmpty());
  drive.follow_stop(false, now);
  drive.feel(touch_felt(), now);
  live(drive, now, 10ms);
  EXPECT_THAT(far.wire->read(), ElementsAre(1));
}

}  // namespace
}  // namespace telehug
