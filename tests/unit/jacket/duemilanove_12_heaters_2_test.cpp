// SPDX-License-Identifier: Apache-2.0
//
// Golden test of the shipped jacket with heaters: touches in, exact bytes out.
#include <gmock/gmock.h>

#include <map>

#include "unit/jacket/wired_jacket.hpp"

namespace telehug {
namespace {

using ::testing::IsEmpty;

constexpr const char* file = "duemilanove-12-heaters-2.toml";
constexpr BodyPoint right_flank{-0.8, 1.5};
constexpr BodyPoint left_flank{0.8, 1.5};

Contact hand_on(BodyPoint place, Gesture gesture = Gesture::hold, std::uint32_t id = 1) {
  Contact made = contact_in(place.x_fh < 0 ? 16 : 20, id);
  made.body = place;
  made.gesture = gesture;
  return made;
}

TEST(Duemilanove12Heaters2, DrivesTheMotorsAboutTheMiddleOfEachBox) {
  const std::map<int, std::string> golden{
      {1, "0=123 170ms, 2=132 170ms"},
      {2, "0=148 170ms"},
      {3, "0=123 170ms, 1=123 170ms"},
      {4, "1=148 170ms"},
      {5, "1=123 170ms, 6=132 170ms"},
      {6, "2=148 170ms"},
      {7, "0=90 170ms, 2=90 170ms, 3=140 170ms"},
      {8, "0=82 170ms, 1=82 170ms, 4=140 170ms"},
      {9, "1=90 170ms, 5=140 170ms, 6=90 170ms"},
      {10, "6=148 170ms"},
      {11, "2=132 170ms, 10=115 170ms"},
      {12, "2=74 170ms, 3=90 170ms, 7=140 170ms"},
      {13, "4=90 170ms, 8=140 170ms"},
      {14, "5=90 170ms, 6=74 170ms, 9=140 170ms"},
      {15, "6=132 170ms, 11=115 170ms"},
      {16, "2=115 170ms, 10=132 170ms"},
      {17, "2=90 170ms, 10=148 170ms"},
      {18, "10=123 170ms, 11=123 170ms"},
      {19, "6=90 170ms, 11=148 170ms"},
      {20, "6=115 170ms, 11=132 170ms"},
  };
  for (const auto& [box, commands] : golden) {
    WiredJacket jacket(file);
    jacket.feel(contact_in(box));
    jacket.rest(contact_in(box), 60ms);
    EXPECT_EQ(jacket.motors_told(), commands) << "box " << box;
  }
}

TEST(Duemilanove12Heaters2, SaysATapBetweenTwoMotorsInTheseBytes) {
  WiredJacket jacket(file);
  Contact tap = contact_in(13);
  tap.body = {0.25, 1.30};
  jacket.feel(tap);
  jacket.pass(30ms);
  tap.phase = Phase::up;
  tap.gesture = Gesture::tap;
  jacket.feel(tap);
  jacket.pass(30ms);
  jacket.feel(std::vector<Contact>{});
  jacket.pass(300ms);
  EXPECT_EQ(jacket.log,
            "0: 0b 10 06 08 94 06 09 94 06 80 02 00\n"
            "30: 0b 10 07 08 94 03 09 94 03 01 56 00\n"
            "40: 0b 10 08 08 7b 06 09 7b 06 71 6e 00\n"
            "60: 0b 10 09 08 7b 04 09 7b 04 3a 1b 00\n");
}

TEST(Duemilanove12Heaters2, WarmsThePadUnderAHandThatRestsOnItInTheseBytes) {
  const std::vector<std::pair<std::string, std::string>> golden{
      {"", ""},
      {"", ""},
      {"0=32.0 170ms", "03 13 64 06 40 01 11 22 66 00"},
      {"0=32.7 200ms", "03 13 90 06 47 01 14 47 05 00"},
      {"0=33.4 170ms", "03 13 ba 06 4e 01 11 69 85 00"},
      {"0=34.1 200ms", "03 13 e0 06 55 01 14 c2 35 00"},
      {"0=34.8 190ms", "03 13 0c 06 5c 01 13 93 6b 00"},
      {"0=35.5 170ms", "03 13 34 06 63 01 11 86 ac 00"},
      {"0=36.3 200ms", "03 13 5c 06 6b 01 14 73 4e 00"},
      {"0=37.0 200ms", "03 13 88 06 72 01 14 65 2d 00"},
      {"0=37.7 160ms", "03 13 b1 06 79 01 10 82 39 00"},
      {"0=38.4 190ms", "03 13 d8 06 80 01 13 82 c5 00"},
      {"0=39.0 170ms", "03 13 04 06 86 01 11 a9 eb 00"},
      {"0=39.0 200ms", "03 13 30 06 86 01 14 e4 3e 00"},
  };
  WiredJacket jacket(file);
  Contact hand = hand_on(right_flank);
  jacket.feel(hand);
  for (std::size_t i = 0; i < golden.size(); ++i) {
    jacket.rest(hand, 1020ms);
    EXPECT_EQ(jacket.heaters_told(), golden[i].first) << i;
    EXPECT_EQ(jacket.heat_bytes(), golden[i].second) << i;
  }
  jacket.log.clear();
  hand.phase = Phase::up;
  jacket.feel(hand);
  jacket.feel(std::vector<Contact>{});
  jacket.pass(1s);
  EXPECT_EQ(jacket.log, "14280: 03 13 31 01 01 01 03 cb 7c 00\n") << "heater 0 off, at once";
}

TEST(Duemilanove12Heaters2, WarmsBothPadsInAHugOfTwoHands) {
  WiredJacket jacket(file);
  std::vector<Contact> hands{hand_on(right_flank, Gesture::hug, 1), hand_on(left_flank, Gesture::hug, 2)};
  jacket.feel(hands);
  for (Contact& hand : hands)
    hand.phase = Phase::move;
  for (Duration passed{}; passed < 14s; passed += 30ms) {
    jacket.pass(30ms);
    jacket.feel(hands);
  }
  EXPECT_EQ(jacket.heaters_told(), "0=39.0 200ms, 1=39.0 200ms");
}

TEST(Duemilanove12Heaters2, KeepsItsPadsColdUnderAHandThatStrokes) {
  WiredJacket jacket(file);
  const Contact hand = hand_on(right_flank, Gesture::stroke);
  jacket.feel(hand);
  jacket.rest(hand, 15s);
  EXPECT_THAT(jacket.heaters_told(), IsEmpty());
}

}  // namespace
}  // namespace telehug
