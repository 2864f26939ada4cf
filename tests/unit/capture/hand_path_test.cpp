// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand_path.hpp"

#include <gmock/gmock.h>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

constexpr ScreenSize screen{380, 300, 1280, 1024};

class HandPathFile : public ::testing::Test {
 protected:
  Result<HandPath> read(std::string_view text) { return read_hand_path(folder_.write("hand.csv", text), screen); }
  std::string fault(std::string_view text) {
    const auto path = read(text);
    return path ? "" : path.error().message;
  }
  TemporaryFolder folder_;
};

TEST_F(HandPathFile, MovesTheHandEvenlyFromRowToRow) {
  const auto path = read("t_s,x_mm,y_mm,hover_mm\n1,100,200,0\n2,200,240,0\n2.5,200,240,50\n");
  ASSERT_TRUE(path) << path.error().message;
  const std::vector<HandPose> hands = hands_at(*path, 1.25);
  ASSERT_EQ(hands.size(), 1u);
  EXPECT_DOUBLE_EQ(hands[0].finger.foot.x_mm, 125);
  EXPECT_DOUBLE_EQ(hands[0].finger.foot.y_mm, 210);
  EXPECT_EQ(hands[0].finger.hover_mm, 0);
  EXPECT_DOUBLE_EQ(hands[0].velocity_mm_per_s[0], 100);
  EXPECT_DOUBLE_EQ(hands[0].velocity_mm_per_s[1], 40);
  EXPECT_FALSE(hands[0].second);
  EXPECT_DOUBLE_EQ(hands_at(*path, 2.25)[0].finger.hover_mm, 25);
  EXPECT_DOUBLE_EQ(hands_at(*path, 2.25)[0].velocity_mm_per_s[2], 100);
}

TEST_F(HandPathFile, HasNobodyThereBeforeItsFirstAndAfterItsLastRow) {
  const auto path = read("t_s,x_mm,y_mm,hover_mm\n1,100,200,0\n2,200,240,0\n");
  ASSERT_TRUE(path);
  EXPECT_TRUE(hands_at(*path, 0.99).empty());
  EXPECT_FALSE(hands_at(*path, 1).empty());
  EXPECT_TRUE(hands_at(*path, 2).empty());
  EXPECT_TRUE(hands_at({}, 1).empty());
}

TEST_F(HandPathFile, HasASecondFingerWhereBothRowsTellOne) {
  const auto path =
      read("t_s,x_mm,y_mm,hover_mm,second_x_mm,second_y_mm\n0,100,200,0,130,190\n1,110,200,4,140,190\n2,110,200,0,,\n");
  ASSERT_TRUE(path) << path.error().message;
  const auto second = hands_at(*path, 0.5)[0].second;
  ASSERT_TRUE(second);
  EXPECT_DOUBLE_EQ(second->foot.x_mm, 135);
  EXPECT_DOUBLE_EQ(second->hover_mm, 2);
  EXPECT_FALSE(hands_at(*path, 1.5)[0].second);
}

TEST_F(HandPathFile, IsRefusedWithTheLineOfEachFault) {
  EXPECT_THAT(fault("t_s,x_mm,y_mm\n"), HasSubstr("column 'hover_mm' is missing"));
  const std::string all = fault(
      "t_s,x_mm,y_mm,hover_mm,second_x_mm,second_y_mm\n1,100,200,0,,\n1,100,200,0,,\n2,nan,200,0,,\n3,1,1,-1,,\n"
      "4,1,700,0,,\n5,1,1,301,,\n6,1,1,0,7,\n");
  for (const char* line : {":3: t_s must be later", ":4:", ":5: hover_mm must be 0 to 300",
                           ":6: the place is more than 300 mm beside the screen", ":7: hover_mm", ":8:"})
    EXPECT_THAT(all, HasSubstr(line));
}

}  // namespace
}  // namespace telehug
