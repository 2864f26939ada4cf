// SPDX-License-Identifier: Apache-2.0
#include "gpio/emergency_stop.hpp"

#include <gtest/gtest.h>

#include <random>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

class AnEmergencyStop : public testing::Test {
 protected:
  // The button's contact, now.
  void contact(bool active) { button_.level(active, clock_.now()); }
  // What it orders within the time that follows, looked at every millisecond, as a daemon would carry it out.
  void pass(Duration time) {
    for (const Timestamp end = clock_.now() + time; clock_.now() < end;) {
      clock_.advance(1ms);
      look();
    }
  }
  void look() {
    const auto orders = button_.orders(clock_.now(), stopped_);
    if (orders.stop) {
      stopped_ = true;
      ++stops_;
      stopped_at_ = clock_.now();
    }
    if (orders.resume) {
      stopped_ = false;
      ++resumes_;
    }
  }
  void press(Duration time) {
    contact(true);
    pass(time);
    contact(false);
    pass(100ms);
  }

  FakeClock clock_;
  EmergencyStop button_{EmergencyStop::Settings{}, false};
  bool stopped_ = false;
  int stops_ = 0;
  int resumes_ = 0;
  Timestamp stopped_at_{};
};

TEST_F(AnEmergencyStop, DoesNothingWhileNobodyPresses) {
  pass(10s);
  EXPECT_EQ(stops_ + resumes_, 0);
  EXPECT_FALSE(button_.pressed());
}

TEST_F(AnEmergencyStop, StopsWhenItIsPressed) {
  contact(true);
  const Timestamp pressed = clock_.now();
  pass(50ms);
  EXPECT_EQ(stops_, 1);
  EXPECT_EQ(stopped_at_ - pressed, 10ms);
  EXPECT_TRUE(button_.pressed());
}

TEST_F(AnEmergencyStop, IsDueWhenAPressSettles) {
  EXPECT_FALSE(button_.due());
  contact(true);
  EXPECT_EQ(button_.due(), clock_.now() + 10ms);
  pass(10ms);
  EXPECT_FALSE(button_.due());
}

TEST_F(AnEmergencyStop, StaysStoppedAfterItIsLetGo) {
  press(200ms);
  pass(1min);
  EXPECT_TRUE(stopped_);
  EXPECT_FALSE(button_.pressed());
  EXPECT_EQ(stops_, 1);
  EXPECT_EQ(resumes_, 0);
}

TEST_F(AnEmergencyStop, TakesABouncingContactForOnePress) {
  for (int i = 0; i < 5; ++i) {
    contact(i % 2 == 0);
    pass(2ms);
  }
  pass(1s);
  EXPECT_EQ(stops_, 1);
  for (int i = 0; i < 5; ++i) {
    contact(i % 2 != 0);
    pass(2ms);
  }
  pass(1s);
  EXPECT_EQ(stops_, 1);
  EXPECT_FALSE(button_.pressed());
}

TEST_F(AnEmergencyStop, IgnoresASpikeThatNoFingerMakes) {
  contact(true);
  pass(3ms);
  contact(false);
  pass(1s);
  EXPECT_EQ(stops_, 0);
}

// A cable that is torn off picks up the mains.
TEST_F(AnEmergencyStop, StopsForAContactThatNeverSettles) {
  const Timestamp torn = clock_.now();
  for (int i = 0; i < 10; ++i) {
    contact(i % 2 == 0);
    pass(5ms);
  }
  EXPECT_EQ(stops_, 1);
  EXPECT_LE(stopped_at_ - torn, 30ms);
}

TEST_F(AnEmergencyStop, StopsWithin30MsHoweverItsContactBounces) {
  std::mt19937 random(7);
  for (int run = 0; run < 500; ++run) {
    EmergencyStop button(EmergencyStop::Settings{}, false);
    const int bounces_ms = static_cast<int>(random() % 40);
    bool stopped = false;
    for (int ms = 0; ms <= 30; ++ms) {
      const Timestamp now = clock_.now() + std::chrono::milliseconds(ms);
      button.level(ms >= bounces_ms || ms % 5 == 0 || random() % 2 == 0, now);
      stopped = button.orders(now, stopped).stop || stopped;
    }
    EXPECT_TRUE(stopped) << "bouncing for " << bounces_ms << " ms";
  }
}

TEST_F(AnEmergencyStop, NoticesAPressThatIsOverWhenItIsToldOfIt) {
  const Timestamp pressed = clock_.now();
  clock_.advance(200ms);
  button_.level(true, pressed);
  button_.level(false, pressed + 60ms);
  look();
  EXPECT_EQ(stops_, 1);
  EXPECT_FALSE(button_.pressed());
}

TEST_F(AnEmergencyStop, KnowsHowLongAPressWasThatIsOverWhenItIsToldOfIt) {
  press(200ms);
  const Timestamp pressed = clock_.now();
  clock_.advance(6s);
  button_.level(true, pressed);
  button_.level(false, pressed + 5s);
  look();
  EXPECT_EQ(resumes_, 1);
}

TEST_F(AnEmergencyStop, DoesNotResumeByThePressThatStopped) {
  press(8s);
  EXPECT_TRUE(stopped_);
  EXPECT_EQ(resumes_, 0);
}

TEST_F(AnEmergencyStop, ResumesWhenItIsHeldFor5SecondsOnceMore) {
  press(200ms);
  contact(true);
  pass(6s);
  EXPECT_TRUE(stopped_) << "not before it is let go";
  contact(false);
  pass(100ms);
  EXPECT_FALSE(stopped_);
  EXPECT_EQ(resumes_, 1);
}

TEST_F(AnEmergencyStop, ResumesWhatStoppedElsewhere) {
  stopped_ = true;
  look();
  press(5s);
  EXPECT_FALSE(stopped_);
}

TEST_F(AnEmergencyStop, DoesNotResumeWhenItIsHeldForTooShort) {
  press(200ms);
  press(4990ms);
  EXPECT_TRUE(stopped_);
}

// It latches, or its cable is broken.
TEST_F(AnEmergencyStop, DoesNotResumeWhenItIsHeldForTooLong) {
  press(200ms);
  press(5s + EmergencyStop::to_let_go + 1ms);
  EXPECT_TRUE(stopped_);
}

TEST_F(AnEmergencyStop, CanBeSetNeverToResume) {
  button_ = EmergencyStop(EmergencyStop::Settings{.debounce = 10ms, .hold_to_resume = 0s}, false);
  press(200ms);
  press(6s);
  EXPECT_TRUE(stopped_);
}

TEST_F(AnEmergencyStop, StopsAtOnceWhenItIsPressedAtTheStart) {
  button_ = EmergencyStop(EmergencyStop::Settings{}, true);
  look();
  EXPECT_TRUE(stopped_);
  EXPECT_TRUE(button_.pressed());
  pass(6s);
  contact(false);
  pass(100ms);
  EXPECT_TRUE(stopped_) << "a press from before the start resumes nothing";
}

TEST_F(AnEmergencyStop, StopsForGoodWhenItsLineIsLost) {
  pass(1s);
  button_.lose();
  look();
  EXPECT_EQ(stops_, 1);
  EXPECT_TRUE(button_.pressed());
  press(6s);
  press(6s);
  EXPECT_TRUE(button_.pressed());
  EXPECT_EQ(resumes_, 0);
}

TEST_F(AnEmergencyStop, DoesNotResumeWhenItsLineIsLostWhileItIsHeld) {
  press(200ms);
  contact(true);
  pass(6s);
  button_.lose();
  contact(false);
  pass(100ms);
  EXPECT_TRUE(stopped_);
  EXPECT_EQ(resumes_, 0);
}

TEST_F(AnEmergencyStop, StopsAgainAfterItHasResumed) {
  press(200ms);
  press(6s);
  ASSERT_FALSE(stopped_);
  press(200ms);
  EXPECT_TRUE(stopped_);
}

}  // namespace
}  // namespace telehug
