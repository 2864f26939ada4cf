// SPDX-License-Identifier: Apache-2.0
#include "local_touch/uinput_touchscreen.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <set>

#include "doubles/fake_uinput.hpp"

namespace telehug {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr ScreenSize screen{376.5, 301, 1280, 1024};

ContactState contact(std::uint32_t id, Phase phase, ScreenPoint at) {
  return {.id = id, .phase = phase, .screen = at, .frame_time = {}};
}

class ATouchscreen : public testing::Test {
 protected:
  Status send(const ContactStates& contacts) { return touchscreen_.send(contacts, Timestamp{}); }
  std::string why_not_open() {
    const Status opened = touchscreen_.open(screen);
    return opened ? "" : opened.error().message;
  }

  FakeUinput kernel_;
  UinputTouchscreen touchscreen_{kernel_};
};

TEST_F(ATouchscreen, IsADirectMultitouchDeviceOfTheScreensSize) {
  ASSERT_TRUE(touchscreen_.open(screen));
  EXPECT_EQ(kernel_.name, "telehug touchscreen");
  EXPECT_EQ(kernel_.phys, "telehug/touchscreen0");
  EXPECT_TRUE(kernel_.direct);
  EXPECT_EQ(kernel_.axes.at(ABS_MT_SLOT).maximum, 9);
  EXPECT_EQ(kernel_.axes.at(ABS_MT_TRACKING_ID).maximum, 65535);
  for (const auto code : {ABS_X, ABS_MT_POSITION_X}) {
    EXPECT_EQ(kernel_.axes.at(code).minimum, 0);
    EXPECT_EQ(kernel_.axes.at(code).maximum, 37650);
    EXPECT_EQ(kernel_.axes.at(code).resolution, 100);
  }
  EXPECT_EQ(kernel_.axes.at(ABS_Y).maximum, 30100);
  EXPECT_EQ(kernel_.axes.at(ABS_MT_POSITION_Y).maximum, 30100);
  EXPECT_EQ(touchscreen_.name(), "touchscreen /dev/input/event99");
}

TEST_F(ATouchscreen, FollowsAFingerFromDownToUp) {
  ASSERT_TRUE(touchscreen_.open(screen));
  ASSERT_TRUE(send({contact(7, Phase::down, {100.25, 50.5})}));
  ASSERT_EQ(kernel_.touching.size(), 1U);
  EXPECT_EQ(kernel_.touching[0].x, 10025);
  EXPECT_EQ(kernel_.touching[0].y, 5050);
  EXPECT_EQ(kernel_.keys[BTN_TOUCH], 1);
  EXPECT_EQ(kernel_.pointer_x, 10025);
  ASSERT_TRUE(send({contact(7, Phase::move, {101, 60})}));
  EXPECT_EQ(kernel_.touching[0].y, 6000);
  EXPECT_EQ(kernel_.pointer_y, 6000);
  ASSERT_TRUE(send({contact(7, Phase::up, {101, 60})}));
  EXPECT_TRUE(kernel_.touching.empty());
  EXPECT_EQ(kernel_.keys[BTN_TOUCH], 0);
  EXPECT_EQ(kernel_.unfinished, 0);
  EXPECT_EQ(kernel_.reports, 3);
}

TEST_F(ATouchscreen, SaysNothingWhileNothingChanges) {
  ASSERT_TRUE(touchscreen_.open(screen));
  ASSERT_TRUE(send({}));
  EXPECT_EQ(kernel_.reports, 0);
  ASSERT_TRUE(send({contact(1, Phase::down, {10, 10})}));
  ASSERT_TRUE(send({contact(1, Phase::move, {10, 10})}));
  EXPECT_EQ(kernel_.reports, 1);
}

TEST_F(ATouchscreen, LetsTheOldestFingerPointForProgramsThatKnowOne) {
  ASSERT_TRUE(touchscreen_.open(screen));
  ASSERT_TRUE(send({contact(1, Phase::down, {10, 10})}));
  ASSERT_TRUE(send({contact(1, Phase::move, {11, 10}), contact(2, Phase::down, {50, 50})}));
  EXPECT_EQ(kernel_.pointer_x, 1100);
  ASSERT_TRUE(send({contact(1, Phase::up, {11, 10}), contact(2, Phase::move, {51, 50})}));
  EXPECT_EQ(kernel_.pointer_x, 5100);
  EXPECT_EQ(kernel_.keys[BTN_TOUCH], 1);
}

TEST_F(ATouchscreen, LiftsAContactThatVanishedWithoutAnUp) {
  ASSERT_TRUE(touchscreen_.open(screen));
  ASSERT_TRUE(send({contact(1, Phase::down, {10, 10}), contact(2, Phase::down, {90, 10})}));
  ASSERT_TRUE(send({contact(2, Phase::move, {90, 10})}));
  ASSERT_EQ(kernel_.touching.size(), 1U);
  EXPECT_EQ(kernel_.touching.begin()->second.x, 9000);
}

TEST_F(ATouchscreen, KeepsTouchesOutsideTheScreenAtItsEdge) {
  ASSERT_TRUE(touchscreen_.open(screen));
  ASSERT_TRUE(send({contact(1, Phase::down, {-15, 320})}));
  EXPECT_EQ(kernel_.touching[0].x, 0);
  EXPECT_EQ(kernel_.touching[0].y, 30100);
}

TEST_F(ATouchscreen, VanishesWhenItIsClosed) {
  ASSERT_TRUE(touchscreen_.open(screen));
  ASSERT_TRUE(send({contact(1, Phase::down, {10, 10})}));
  touchscreen_.close();
  EXPECT_EQ(kernel_.devices_now, 0);
  ASSERT_TRUE(touchscreen_.open(screen));
  ASSERT_TRUE(send({contact(1, Phase::move, {10, 10})}));
  EXPECT_EQ(kernel_.touching.size(), 1U) << "a finger that is still there touches the new device";
}

TEST_F(ATouchscreen, SaysWhatToDoWhenItCantBeMade) {
  kernel_.error = EACCES;
  EXPECT_THAT(why_not_open(), AllOf(HasSubstr("/dev/uinput"), HasSubstr("70-telehug-uinput.rules")));
  kernel_.error = ENOENT;
  EXPECT_THAT(why_not_open(), HasSubstr("modprobe uinput"));
  kernel_.error = EINVAL;
  EXPECT_THAT(why_not_open(), HasSubstr("Invalid argument"));
}

TEST_F(ATouchscreen, SaysThatItCantBeWrittenTo) {
  ASSERT_TRUE(touchscreen_.open(screen));
  kernel_.write_error = ENODEV;
  EXPECT_FALSE(send({contact(1, Phase::down, {10, 10})}));
}

// Whatever contacts come: what the kernel was told is what touches.
TEST_F(ATouchscreen, ShowsWhatTouchesForAnyContacts) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::uint32_t> id(1, 14);
  std::uniform_int_distribution<int> any(0, 300);
  ASSERT_TRUE(touchscreen_.open(screen));
  for (int i = 0; i < 5000; ++i) {
    ContactStates contacts;
    std::set<std::uint32_t> used;
    std::multiset<int> expected;
    for (int n = any(random) % 11; n > 0; --n) {
      const std::uint32_t next = id(random);
      if (!used.insert(next).second) continue;
      const Phase phase = any(random) % 4 == 0 ? Phase::up : Phase::move;
      const int x_mm = any(random);
      contacts.push_back(contact(next, phase, {static_cast<double>(x_mm), 20}));
      if (phase != Phase::up) expected.insert(100 * x_mm);
    }
    ASSERT_TRUE(send(contacts));
    std::multiset<int> shown;
    std::set<int> tracking;
    for (const auto& [slot, touch] : kernel_.touching) {
      ASSERT_LT(slot, 10);
      shown.insert(touch.x);
      tracking.insert(touch.tracking_id);
    }
    ASSERT_EQ(shown, expected);
    ASSERT_EQ(tracking.size(), shown.size());
    ASSERT_EQ(kernel_.keys[BTN_TOUCH], shown.empty() ? 0 : 1);
  }
}

}  // namespace
}  // namespace telehug
