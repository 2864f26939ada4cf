// SPDX-License-Identifier: Apache-2.0
#include "touch/contact_smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "doubles/simulated_hand.hpp"

namespace telehug {
namespace {

class Smoothing : public testing::TestWithParam<double> {
 protected:
  [[nodiscard]] double seconds() const { return 1 / GetParam(); }
  ScreenPoint noisy(double x_mm, double noise_mm) {
    std::normal_distribution<double> noise(0, noise_mm);
    return {x_mm + noise(random_), noise(random_)};
  }
  std::mt19937 random_{5};
};

std::string rate_name(const testing::TestParamInfo<double>& rate) {
  return std::to_string(static_cast<int>(rate.param));
}

INSTANTIATE_TEST_SUITE_P(FramesPerSecond, Smoothing, testing::Values(30.0, 60.0), rate_name);

TEST_P(Smoothing, CalmsARestingFinger) {
  ContactSmoothing smoothing;
  smoothing.update({0, 0}, 0);
  double squares = 0;
  constexpr int frames = 5000;
  for (int i = 0; i < frames; ++i) {
    const ScreenPoint at = smoothing.update(noisy(0, 0.5), seconds());
    squares += at.x_mm * at.x_mm;
  }
  EXPECT_LT(std::sqrt(squares / frames), 0.35);
}

// Of a stroke that goes up to `fastest_mm_s`, while it has more than a third of that.
struct Lag {
  double mean_ms = 0;
  double most_mm = 0;
};

TEST_P(Smoothing, DoesNotTrailAStroke) {
  const auto stroke = [this](double fastest_mm_s, double lasts_s) {
    ContactSmoothing smoothing;
    smoothing.update({0, 0}, 0);
    const double length_mm = fastest_mm_s * lasts_s / 1.875;
    Lag lag;
    int frames = 0;
    double before_mm = 0;
    for (double t = seconds(); t < lasts_s; t += seconds()) {
      const double x_mm = length_mm * minimum_jerk(t / lasts_s);
      const double speed_mm_s = (x_mm - before_mm) / seconds();
      before_mm = x_mm;
      const double behind_mm = x_mm - smoothing.update({x_mm, 0}, seconds()).x_mm;
      lag.most_mm = std::max(lag.most_mm, behind_mm);
      if (speed_mm_s < fastest_mm_s / 3) continue;
      lag.mean_ms += 1000 * behind_mm / speed_mm_s;
      ++frames;
    }
    lag.mean_ms /= frames;
    return lag;
  };
  const Lag fast = stroke(1000, 0.35);
  EXPECT_LT(fast.mean_ms, 0.5);
  EXPECT_LT(fast.most_mm, 2);
  const Lag slow = stroke(200, 0.5);
  EXPECT_LT(slow.mean_ms, 5);
  EXPECT_LT(slow.most_mm, 2);
}

TEST_P(Smoothing, BeginsWhereTheContactBegins) {
  ContactSmoothing smoothing;
  smoothing.update({0, 0}, 0);
  smoothing.reset();
  EXPECT_EQ(smoothing.update({300, 20}, seconds()).x_mm, 300);
}

}  // namespace
}  // namespace telehug
