// SPDX-License-Identifier: Apache-2.0
#include "finger/background_strip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "doubles/allocation_counter.hpp"
#include "doubles/drawn_band.hpp"

namespace telehug {
namespace {

constexpr ImageSize size{1280, 720};
constexpr double border_v = 400;

class Background : public testing::Test {
 protected:
  BorderStrip strip_of(const cv::Mat& picture) const {
    BorderStrip strip(layout_);
    strip.sample(picture, layout_);
    return strip;
  }
  // The empty strip with one value more in some columns.
  BorderStrip changed(float by, int first = 300, int last = 310) const {
    BorderStrip strip = empty_;
    for (int rail = 0; rail < BorderStrip::rails; ++rail) {
      for (int channel = 0; channel < BorderStrip::channels; ++channel) {
        for (int i = first; i < last; ++i)
          strip.row(channel, rail)[i] += by;
      }
    }
    return strip;
  }
  [[nodiscard]] float at(const std::vector<float>& values, int rail, int column) const {
    return values[static_cast<std::size_t>(rail * layout_.columns + column)];
  }
  // How much of a change is learned after so many frames that show it.
  double learned(float change, int frames, bool finger) {
    const BorderStrip now = changed(change);
    std::vector<bool> is_finger(static_cast<std::size_t>(layout_.columns), false);
    if (finger) std::fill(is_finger.begin() + 300, is_finger.begin() + 310, true);
    const float before = at(background_.distance(now), 4, 305);
    for (int i = 0; i < frames; ++i) {
      background_.distance(now);
      background_.adapt(now, is_finger);
    }
    return 1 - static_cast<double>(at(background_.distance(now), 4, 305) / before);
  }

  BorderStrip::Layout layout_{BorderCurve(BorderLine{border_v, 0}, size), size};
  BorderStrip empty_ = strip_of(drawn_desk(size.width_px, size.height_px));
  BackgroundStrip background_{layout_, empty_};
};

TEST_F(Background, NoiseIsNoForeground) {
  for (unsigned seed = 1; seed < 5; ++seed) {
    const auto& distance = background_.distance(strip_of(drawn_desk(size.width_px, size.height_px, seed, 4)));
    EXPECT_EQ(std::count_if(distance.begin(), distance.end(), [](float d) { return d > 2; }), 0);
    EXPECT_GT(background_.unchanged_share(), 0.99);
  }
}

TEST_F(Background, ExposureAndWhiteBalanceMayChangeFromFrameToFrame) {
  const std::array<cv::Vec3d, 6> gains{
      {{0.5, 0.5, 0.5}, {1.6, 1.6, 1.6}, {0.8, 1, 1.2}, {1.25, 1, 0.8}, {0.6, 0.7, 0.8}, {1.5, 1.3, 1.1}}};
  for (const cv::Vec3d& gain : gains) {
    cv::Mat picture = drawn_desk(size.width_px, size.height_px, 3, 2);
    for (auto& pixel : cv::Mat_<cv::Vec3b>(picture)) {
      for (int c = 0; c < 3; ++c)
        pixel[c] = cv::saturate_cast<std::uint8_t>(gain[c] * pixel[c]);
    }
    draw_band(picture, {.u_px = 640, .v_px = border_v, .half_width_px = 90});
    const auto& distance = background_.distance(strip_of(picture));
    int foreground = 0;
    for (int rail = 0; rail < BorderStrip::rails; ++rail) {
      for (int i = 0; i < layout_.columns; ++i) {
        if (std::abs(layout_.column_centre_px(i) - 640) > 95) foreground += at(distance, rail, i) > 2 ? 1 : 0;
      }
      EXPECT_GT(at(distance, rail, 320), 2) << "the finger";
    }
    EXPECT_EQ(foreground, 0) << gain[0] << ", " << gain[2];
  }
}

TEST_F(Background, DistanceIsInStandardDeviationsThatGrowWithBrightness) {
  const auto& distance = background_.distance(changed(8));
  for (const int rail : {0, 7, 15}) {
    double sum = 0;
    for (int channel = 0; channel < BorderStrip::channels; ++channel) {
      const double level = empty_.row(channel, rail)[305];
      sum += 64 / (9 + 0.06 * 0.06 * level * level);
    }
    EXPECT_NEAR(at(distance, rail, 305), std::sqrt(sum / 3), 0.03);
    EXPECT_NEAR(at(distance, rail, 100), 0, 0.03);
  }
}

TEST_F(Background, DistanceEndsAtFar) {
  EXPECT_EQ(at(background_.distance(changed(120)), 3, 305), BackgroundStrip::far);
}

TEST_F(Background, AnotherSceneIsUnchangedHardlyAnywhere) {
  cv::Mat other(size.height_px, size.width_px, CV_8UC3);
  for (int v = 0; v < other.rows; ++v) {
    for (int u = 0; u < other.cols; ++u)
      other.at<cv::Vec3b>(v, u) = u / 16 % 2 == 0 ? cv::Vec3b(200, 40, 90) : cv::Vec3b(20, 160, 30);
  }
  background_.distance(strip_of(other));
  EXPECT_LT(background_.unchanged_share(), 0.1);
}

TEST_F(Background, SmallChangesAreLearnedWithinASecond) {
  EXPECT_GT(learned(6, 30, false), 0.8);
}

TEST_F(Background, AThingThatIsPutThereIsLearnedOnlyWithinAMinute) {
  EXPECT_LT(learned(20, 30, false), 0.15);
  EXPECT_GT(learned(20, 30 * 60, false), 0.8);
}

TEST_F(Background, AFingerIsHardlyLearned) {
  EXPECT_LT(learned(20, 30 * 10, true), 0.15);
}

TEST_F(Background, AllocatesNothingPerFrame) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted";
  const BorderStrip now = changed(10);
  const std::vector<bool> none(static_cast<std::size_t>(layout_.columns), false);
  const auto before = allocation_count();
  background_.distance(now);
  background_.adapt(now, none);
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
