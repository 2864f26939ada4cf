// SPDX-License-Identifier: Apache-2.0
#include "body_map/choose_remote_face.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

constexpr ImageSize screen{.width_px = 1000, .height_px = 1000};

FoundFace face_at(double centre_x, double centre_y, double height, double score = 1) {
  return {.box = {centre_x - height * 0.36, centre_y - height / 2, height * 0.72, height}, .score = score};
}

TEST(ChooseRemoteFace, FindsNoneAmongNone) {
  EXPECT_FALSE(choose_remote_face({}, screen));
}

TEST(ChooseRemoteFace, TakesTheLargest) {
  const auto chosen =
      choose_remote_face({face_at(300, 500, 150), face_at(500, 500, 200), face_at(700, 500, 199, 9)}, screen);
  ASSERT_TRUE(chosen);
  EXPECT_DOUBLE_EQ(chosen->box.height, 200);
}

TEST(ChooseRemoteFace, LeavesOutTheOwnPictureInAnyCorner) {
  for (const double x : {150.0, 850.0}) {
    for (const double y : {150.0, 850.0}) {
      const auto chosen = choose_remote_face({face_at(x, y, 250), face_at(500, 400, 200)}, screen);
      ASSERT_TRUE(chosen);
      EXPECT_DOUBLE_EQ(chosen->box.height, 200);
      EXPECT_FALSE(choose_remote_face({face_at(x, y, 250)}, screen));
    }
  }
}

TEST(ChooseRemoteFace, TakesAFaceAtTheMiddleOfAnEdge) {
  EXPECT_TRUE(choose_remote_face({face_at(500, 100, 200)}, screen));
  EXPECT_TRUE(choose_remote_face({face_at(100, 500, 200)}, screen));
}

TEST(ChooseRemoteFace, LeavesOutFacesThatAreTooSmall) {
  EXPECT_FALSE(choose_remote_face({face_at(500, 500, 69)}, screen));
  EXPECT_TRUE(choose_remote_face({face_at(500, 500, 71)}, screen));
}

}  // namespace
}  // namespace telehug
