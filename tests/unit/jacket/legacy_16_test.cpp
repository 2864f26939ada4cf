// SPDX-License-Identifier: Apache-2.0
//
// Golden test of the shipped profile for the thesis' jacket: touches in, exact bytes out.
#include <gtest/gtest.h>

#include <map>

#include "unit/jacket/wired_jacket.hpp"

namespace telehug {
namespace {

constexpr const char* file = "legacy-16.toml";

TEST(Legacy16, SaysTheBareNumbersOfTheMotorsOfEachBox) {
  const std::map<int, std::string> golden{
      {1, "01"},  {2, "02"},  {3, "02 03"}, {4, "03"},     {5, "04"},  {6, "05"},  {7, "06"},
      {8, "07"},  {9, "08"},  {10, "09"},   {11, "0a"},    {12, "0b"}, {13, "0c"}, {14, "0d"},
      {15, "0e"}, {16, "0a"}, {17, "0f"},   {18, "0f 10"}, {19, "10"}, {20, "0e"}, {22, "0f"},
  };
  for (const auto& [box, bytes] : golden) {
    WiredJacket jacket(file);
    Contact touch = contact_in(box);
    touch.grid = {5, 5};
    jacket.feel(touch);
    jacket.pass(300ms);
    EXPECT_EQ(jacket.log, "0: " + bytes + "\n") << "box " << box;
  }
}

TEST(Legacy16, RepeatsTheNumberOnlyWhileTheFingerRests) {
  WiredJacket jacket(file);
  Contact finger = contact_in(8);
  jacket.feel(finger);
  jacket.rest(finger, 900ms);
  finger.phase = Phase::up;
  jacket.feel(finger);
  jacket.pass(1s);
  EXPECT_EQ(jacket.log,
            "0: 07\n"
            "200: 07\n"
            "400: 07\n"
            "600: 07\n"
            "800: 07\n");
}

}  // namespace
}  // namespace telehug
