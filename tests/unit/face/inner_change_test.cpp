// SPDX-License-Identifier: Apache-2.0
#include "face/inner_change.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace telehug {
namespace {

const cv::Rect2d box(100, 50, 72, 100);

cv::Mat noise(int type, double from = 0, double to = 255) {
  cv::Mat picture(300, 400, type);
  cv::randu(picture, cv::Scalar::all(from), cv::Scalar::all(to));
  return picture;
}

TEST(InnerChange, SeesNoneAtTheFirstLookAndInAStillPicture) {
  const cv::Mat picture = noise(CV_8UC3);
  InnerChange inside;
  EXPECT_FALSE(inside.look(picture, box));
  EXPECT_FALSE(inside.look(picture.clone(), box));
}

TEST(InnerChange, SeesWhatChangesInside) {
  for (const int type : {CV_8UC3, CV_8UC4}) {
    InnerChange inside;
    inside.look(noise(type), box);
    EXPECT_TRUE(inside.look(noise(type), box));
  }
}

TEST(InnerChange, SeesNothingOfWhatChangesOutside) {
  const cv::Mat before = noise(CV_8UC3);
  cv::Mat after = noise(CV_8UC3);
  before(cv::Rect(95, 45, 82, 110)).copyTo(after(cv::Rect(95, 45, 82, 110)));
  InnerChange inside;
  inside.look(before, box);
  EXPECT_FALSE(inside.look(after, box));
}

TEST(InnerChange, TakesFaintNoiseForStill) {
  InnerChange inside;
  inside.look(noise(CV_8UC3, 100, 104), box);
  EXPECT_FALSE(inside.look(noise(CV_8UC3, 100, 104), box));
}

TEST(InnerChange, SeesALipThatMoves) {
  const cv::Mat before = noise(CV_8UC3);
  cv::Mat after = before.clone();
  cv::rectangle(after, cv::Rect(125, 120, 24, 8), cv::Scalar(0, 0, 0), cv::FILLED);
  InnerChange inside;
  inside.look(before, box);
  EXPECT_TRUE(inside.look(after, box));
}

// However slowly, and wherever the finder sees it meanwhile.
TEST(InnerChange, TakesAPictureThatIsDraggedForStill) {
  const cv::Mat picture = noise(CV_8UC3);
  for (const int step_px : {1, 2, 3, 5, 8, 20}) {
    InnerChange inside;
    for (int i = 0; i < 10; ++i) {
      const int x = i * step_px;
      cv::Mat screen(300, 400, CV_8UC3, cv::Scalar(0, 0, 0));
      picture(cv::Rect(80, 30, 112, 140)).copyTo(screen(cv::Rect(80 + x, 30, 112, 140)));
      EXPECT_FALSE(inside.look(screen, box + cv::Point2d(x + (i % 3 - 1) * 0.7, 0))) << step_px << " px a look";
    }
  }
}

TEST(InnerChange, TakesAStillPictureForStillWhereTheFinderWavers) {
  const cv::Mat picture = noise(CV_8UC3);
  InnerChange inside;
  for (int i = 0; i < 10; ++i)
    EXPECT_FALSE(inside.look(picture, box + cv::Point2d(i % 2 * 12, 0)));
}

TEST(InnerChange, SeesWhoMovesToAndFroInEveryLook) {
  InnerChange inside;
  int changes = 0;
  for (int i = 0; i < 10; ++i)
    changes += inside.look(noise(CV_8UC3), box + cv::Point2d(i % 2 * 12, 0)) ? 1 : 0;
  EXPECT_EQ(changes, 9);
}

TEST(InnerChange, BearsABoxPastThePicturesEdges) {
  for (const cv::Rect2d& past :
       {cv::Rect2d(-50, -50, 72, 100), cv::Rect2d(390, 290, 72, 100), cv::Rect2d(900, 900, 7, 9)}) {
    InnerChange inside;
    inside.look(noise(CV_8UC4), past);
    inside.look(noise(CV_8UC4), past);
  }
}

}  // namespace
}  // namespace telehug
