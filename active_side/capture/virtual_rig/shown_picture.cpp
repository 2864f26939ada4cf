// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/shown_picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "capture/virtual_rig/value_noise.hpp"

namespace telehug {
namespace {

constexpr float step_mm = 0.5F;  // finer than the camera sees it
constexpr float around_step_mm = 10;
constexpr double pictures_per_s = 30;
constexpr float scrolled_mm_per_s = 45;
constexpr float fade_s = 1.5F;
constexpr float crossing_s = 1.2F;
constexpr float flash_s = 0.25F;
const Light rectangle_light{0.05F, 0.25F, 0.75F};

cv::Mat as_light(const cv::Mat& shown, const ScreenSize& screen, float pixel_mm, double luminance) {
  const auto pixels = [&](double mm) { return std::max(1, cvRound(mm / static_cast<double>(pixel_mm))); };
  const cv::Size size(pixels(screen.width_mm), pixels(screen.height_mm));
  cv::Mat scaled;
  cv::resize(shown, scaled, size, 0, 0, shown.cols > size.width ? cv::INTER_AREA : cv::INTER_LINEAR);
  scaled.convertTo(scaled, CV_32F, 1.0 / 255);
  cv::multiply(scaled, scaled, scaled, luminance);
  return scaled;
}

// Some 40 % of the screen's width and a third of its height, in its lower part, which the camera sees best.
cv::Rect2f window_of(const VirtualRigSettings& settings) {
  if (settings.motion == ScreenMotion::still) return {};
  const auto width_mm = static_cast<float>(settings.screen.width_mm);
  const auto height_mm = static_cast<float>(settings.screen.height_mm);
  const auto random = [&](std::int64_t which, float low, float high) {
    return low + (high - low) * hashed(which, 77, settings.seed);
  };
  const float width = random(0, 0.3F, 0.5F);
  const float height = random(1, 0.25F, 0.4F);
  return {width_mm * random(2, 0.15F, 0.85F - width), height_mm * random(3, 0.5F, 0.95F - height), width_mm * width,
          height_mm * height};
}

}  // namespace

ShownPicture::ShownPicture(const VirtualRigSettings& settings, const cv::Mat& shown)
    : motion_(settings.motion),
      light_(as_light(shown, settings.screen, step_mm, settings.screen_luminance)),
      still_around_(as_light(shown, settings.screen, around_step_mm, settings.screen_luminance)),
      window_(window_of(settings)) {
  light_surroundings();
}

bool ShownPicture::move_to(double time_s) {
  const int picture = static_cast<int>(time_s * pictures_per_s);
  if (motion_ == ScreenMotion::still || picture == picture_) return false;
  picture_ = picture;
  time_s_ = static_cast<float>(picture / pictures_per_s);
  light_surroundings();
  return true;
}

void ShownPicture::light_surroundings() {
  still_around_.copyTo(around_);
  for (int row = 0; row < around_.rows; ++row) {
    for (int column = 0; column < around_.cols; ++column) {
      const float x_mm = (static_cast<float>(column) + 0.5F) * around_step_mm;
      const float y_mm = (static_cast<float>(row) + 0.5F) * around_step_mm;
      if (window_.contains({x_mm, y_mm})) around_.at<Light>(row, column) = in_window(x_mm, y_mm);
    }
  }
  cv::blur(around_, around_, {3, 3});
}

Light ShownPicture::at(float x_mm, float y_mm) const {
  return window_.contains({x_mm, y_mm}) ? in_window(x_mm, y_mm) : still_at(x_mm, y_mm);
}

Light ShownPicture::in_window(float x_mm, float y_mm) const {
  const float x = x_mm - window_.x;
  const float y = y_mm - window_.y;
  switch (motion_) {
    case ScreenMotion::still:
      break;
    case ScreenMotion::scrolling:
      return still_at(x_mm, window_.y + std::fmod(y + time_s_ * scrolled_mm_per_s, window_.height));
    case ScreenMotion::fading: {  // to its own mirror image and back
      const float share = std::abs(std::fmod(time_s_ / fade_s, 2.0F) - 1);
      return still_at(x_mm, y_mm) * share + still_at(window_.x + window_.width - x, y_mm) * (1 - share);
    }
    case ScreenMotion::rectangle: {
      const float way = std::abs(std::fmod(time_s_ / crossing_s, 2.0F) - 1) * 0.7F * window_.width;
      const bool within =
          x > way && x < way + 0.3F * window_.width && y > 0.25F * window_.height && y < 0.75F * window_.height;
      return within ? rectangle_light : still_at(x_mm, y_mm);
    }
    case ScreenMotion::flashing:
      return still_at(x_mm, y_mm) * (std::fmod(time_s_, 2 * flash_s) < flash_s ? 1.0F : 0.25F);
  }
  return still_at(x_mm, y_mm);
}

// Bilinear.
Light ShownPicture::still_at(float x_mm, float y_mm) const {
  const float column = std::clamp(x_mm / step_mm - 0.5F, 0.0F, static_cast<float>(light_.cols - 1));
  const float row = std::clamp(y_mm / step_mm - 0.5F, 0.0F, static_cast<float>(light_.rows - 1));
  const int c0 = static_cast<int>(column);
  const int r0 = static_cast<int>(row);
  const int c1 = std::min(c0 + 1, light_.cols - 1);
  const Light* upper = light_.ptr<Light>(r0);
  const Light* lower = light_.ptr<Light>(std::min(r0 + 1, light_.rows - 1));
  const float fc = column - static_cast<float>(c0);
  const float fr = row - static_cast<float>(r0);
  return (upper[c0] * (1 - fc) + upper[c1] * fc) * (1 - fr) + (lower[c0] * (1 - fc) + lower[c1] * fc) * fr;
}

Light ShownPicture::around(float x_mm, float y_mm) const {
  const int column = std::clamp(static_cast<int>(x_mm / around_step_mm), 0, around_.cols - 1);
  const int row = std::clamp(static_cast<int>(y_mm / around_step_mm), 0, around_.rows - 1);
  return around_.at<Light>(row, column);
}

}  // namespace telehug
