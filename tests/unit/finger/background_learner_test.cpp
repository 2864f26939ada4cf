// SPDX-License-Identifier: Apache-2.0
//
// What becomes background over minutes, and what the detector makes of it meanwhile: on drawn pictures.
#include "finger/background_learner.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "doubles/drawn_finger.hpp"
#include "finger/finger_detector.hpp"

namespace telehug {
namespace {

constexpr ImageSize image{640, 360};
constexpr BorderLine border{260, 0};
constexpr Duration frame_period = 33ms;
constexpr Bgr cup_colour{200, 205, 210};

class BackgroundLearnerTest : public testing::Test {
 protected:
  static DrawnScene scene() { return {border, image}; }
  static cv::Mat empty(unsigned seed = 1) { return scene().noise(seed, 3).picture(); }
  // Some pictures of one scene, whose noise differs.
  static std::vector<cv::Mat> pictures(const std::function<DrawnScene()>& draw) {
    std::vector<cv::Mat> drawn;
    for (unsigned seed = 1; seed <= 4; ++seed)
      drawn.push_back(draw().noise(seed, 3).picture());
    return drawn;
  }
  // A lamp on the other side of the desk.
  static cv::Mat other_light(cv::Mat picture) {
    for (int u = 0; u < picture.cols; ++u)
      picture.col(u) *= 0.3 + 1.8 * u / picture.cols;
    return picture;
  }

  std::size_t see(const cv::Mat& picture) {
    now_ += frame_period;
    const std::size_t found = detector_.detect(picture).size();
    detector_.adapt(now_);
    return detector_.background().trusts() ? found : 0;
  }
  // How many frames of that time have as many fingers as they should.
  struct Watched {
    int frames = 0;
    int right = 0;
  };
  Watched watch(Duration time, const std::vector<cv::Mat>& pictures, std::size_t fingers) {
    Watched watched;
    for (const Timestamp end = now_ + time; now_ < end; ++watched.frames)
      watched.right += see(pictures[static_cast<std::size_t>(watched.frames) % pictures.size()]) == fingers ? 1 : 0;
    return watched;
  }
  double unchanged_share(const cv::Mat& picture) {
    (void)detector_.detect(picture);
    return detector_.unchanged_share();
  }

  static FingerDetector detector_that_knows(const cv::Mat& nobody) {
    const BorderStrip::Layout layout(BorderCurve(border, image), image);
    BorderStrip strip(layout);
    strip.sample(nobody, layout);
    return {BorderCurve(border, image), image, strip, std::nullopt};
  }

  Timestamp now_{};
  FingerDetector detector_ = detector_that_knows(empty());
};

TEST_F(BackgroundLearnerTest, MakesACupThatWasPutThereBackgroundWithinAMinute) {
  const auto cup = pictures([] { return scene().bar(200, 90, -60, -9, cup_colour); });
  ASSERT_LT(unchanged_share(cup[0]), 0.95);
  const Watched watched = watch(60s, cup, 0);
  EXPECT_EQ(watched.right, watched.frames) << "a cup is no finger at any time";
  EXPECT_GT(unchanged_share(cup[0]), 0.98);
}

TEST_F(BackgroundLearnerTest, FindsARestingFingerForTwoMinutesAndNothingWhenItIsGone) {
  const auto finger = pictures([] { return scene().finger(300, 28, 30); });
  const Watched there = watch(120s, finger, 1);
  EXPECT_EQ(there.right, there.frames);
  const Watched gone = watch(5s, pictures(scene), 0);
  EXPECT_EQ(gone.right, gone.frames);
}

TEST_F(BackgroundLearnerTest, RecoversWithinTwoSecondsAfterTheLightWasSwitched) {
  std::vector<cv::Mat> lit;
  for (const cv::Mat& picture : pictures(scene))
    lit.push_back(other_light(picture));
  std::vector<cv::Mat> finger;
  for (const cv::Mat& picture : pictures([] { return scene().finger(300, 28, 30); }))
    finger.push_back(other_light(picture));
  ASSERT_LT(unchanged_share(lit[0]), 0.3);

  const Watched recovering = watch(2s, lit, 0);
  EXPECT_EQ(recovering.right, recovering.frames) << "no light is a finger";
  EXPECT_TRUE(detector_.background().trusts());
  EXPECT_EQ(detector_.background().relearned(), 1U);
  const Watched touched = watch(1s, finger, 1);
  EXPECT_EQ(touched.right, touched.frames);
}

TEST_F(BackgroundLearnerTest, TrustsTheOldBackgroundAgainWhenTheLightIsSoonAsItWas) {
  for (int i = 0; i < 15; ++i)
    see(other_light(empty(2)));
  EXPECT_FALSE(detector_.background().trusts());
  see(empty(2));
  EXPECT_TRUE(detector_.background().trusts());
  EXPECT_EQ(detector_.background().relearned(), 0U);
}

TEST_F(BackgroundLearnerTest, LearnsFromTheFirstPicturesInWhichNothingMoves) {
  detector_ = FingerDetector(BorderCurve(border, image), image, std::nullopt, std::nullopt);
  for (int i = 0; i < 30; ++i) {
    see(scene().bar(40 + 10 * i, 100, -200, -3).noise(1, 3).picture());
    EXPECT_FALSE(detector_.background().trusts());
  }
  watch(600ms, pictures(scene), 0);
  EXPECT_TRUE(detector_.background().trusts());
  EXPECT_EQ(see(scene().finger(300, 28, 30).noise(1, 3).picture()), 1U);
}

}  // namespace
}  // namespace telehug
