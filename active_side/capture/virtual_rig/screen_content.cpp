// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/screen_content.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "capture/virtual_rig/value_noise.hpp"

namespace telehug {
namespace {

using cv::Point;
using cv::Rect;
using cv::Scalar;

cv::Mat plain(const ScreenSize& screen, const Scalar& colour) {
  return {screen.height_px, screen.width_px, CV_8UC3, colour};
}

// Draws in shares of the picture's height, so that contents look alike at every resolution.
class Painter {
 public:
  Painter(cv::Mat& picture, std::uint64_t seed) : picture_(picture), seed_(seed) {}

  [[nodiscard]] double random(double low, double high) {
    return low + (high - low) * static_cast<double>(hashed(++drawn_, 0, seed_));
  }
  [[nodiscard]] Scalar random_colour(double low, double high) {
    const double b = random(low, high);
    const double g = random(low, high);
    return {b, g, random(low, high)};
  }
  [[nodiscard]] int px(double share) const { return cvRound(share * picture_.rows); }
  [[nodiscard]] double width() const { return static_cast<double>(picture_.cols) / picture_.rows; }

  void box(double x, double y, double w, double h, const Scalar& colour) {
    cv::rectangle(picture_, Rect(px(x), px(y), px(w), std::max(1, px(h))), colour, cv::FILLED);
  }
  void oval(double x, double y, double rx, double ry, const Scalar& colour, double turned_deg = 0) {
    cv::ellipse(picture_, {px(x), px(y)}, {px(rx), px(ry)}, turned_deg, 0, 360, colour, cv::FILLED, cv::LINE_AA);
  }

  // Smooth clouds of colour with edges in them: the statistics of a photograph, roughly.
  void clouds(const Rect& place, double cell, double edges) {
    cv::Mat small(std::max(2, place.height / 4), std::max(2, place.width / 4), CV_8UC3);
    const std::uint64_t seed = seed_ + static_cast<std::uint64_t>(++drawn_) * 7919;
    const auto step = static_cast<float>(4 / (cell * picture_.rows));
    for (int row = 0; row < small.rows; ++row) {
      for (int column = 0; column < small.cols; ++column) {
        const float x = static_cast<float>(column) * step;
        const float y = static_cast<float>(row) * step;
        const float shape = fractal_noise(x, y, seed);
        const float side = shape > 0.5F ? static_cast<float>(edges) : 0.0F;
        auto& pixel = small.at<cv::Vec3b>(row, column);
        const float common = fractal_noise(x * 0.7F, y * 0.7F + 57, seed + 31);
        for (int c = 0; c < 3; ++c) {
          const float tone = fractal_noise(x * 0.6F + 31, y * 0.6F, seed + 11 + static_cast<std::uint64_t>(c));
          const float coloured = common + 0.45F * (tone - common);
          pixel[c] = cv::saturate_cast<uchar>(255 * (0.35F + 2.0F * (coloured - 0.45F) + side * (shape - 0.35F)));
        }
      }
    }
    cv::Mat target = picture_(place);
    cv::resize(small, target, place.size(), 0, 0, cv::INTER_LINEAR);
  }

  // Somebody in front of a wall, within (x, y, w, h).
  void person(double x, double y, double w, double h) {
    const Rect place = Rect(px(x), px(y), px(w), px(h)) & Rect({0, 0}, picture_.size());
    if (place.empty()) return;
    clouds(place, 0.5, random(0.0, 0.6));
    cv::Mat whole = picture_;
    picture_ = whole(place);  // what is drawn now is cut off at the window's border
    const double aspect = width();
    const double cx = aspect * random(0.42, 0.58);
    const double head = random(0.17, 0.23);
    static const std::array<Scalar, 5> skins{
        Scalar{190, 208, 240}, {150, 180, 228}, {110, 150, 205}, {70, 105, 160}, {48, 62, 96}};
    const Scalar skin = skins[static_cast<std::size_t>(random(0, 4.999))];
    const Scalar hair = skins[4] * random(0.2, 1.4);
    const Scalar clothes = random_colour(20, 220);
    oval(cx, 1.08, head * 2.3, 0.42, clothes);
    box(cx - head * 0.4, 0.5, head * 0.8, 0.22, skin * 0.85);
    oval(cx, 0.4, head * 1.12, head * 1.4, hair);
    oval(cx, 0.45, head * 0.9, head * 1.2, skin);
    for (const double side : {-1.0, 1.0}) {
      oval(cx + side * head * 0.36, 0.41, head * 0.16, head * 0.08, {225, 230, 235});
      oval(cx + side * head * 0.36, 0.41, head * 0.07, head * 0.07, {40, 40, 50});
      oval(cx + side * head * 0.36, 0.37, head * 0.2, head * 0.035, hair);
    }
    oval(cx, 0.47, head * 0.09, head * 0.2, skin * 0.92);
    oval(cx, 0.56, head * 0.3, head * 0.07, {90, 90, 170});
    picture_ = whole;
  }

 private:
  cv::Mat& picture_;
  std::uint64_t seed_;
  std::int64_t drawn_ = 0;
};

void draw_chat(Painter& painter, cv::Mat& picture) {
  const double width = painter.width();
  picture.setTo(Scalar(32, 30, 28));
  if (painter.random(0, 1) < 0.4) {
    painter.person(0.02, 0.05, width / 2 - 0.03, 0.86);
    painter.person(width / 2 + 0.01, 0.05, width / 2 - 0.03, 0.86);
  } else {
    painter.person(0.0, 0.04, width, 0.9);
    painter.person(width - 0.36, 0.66, 0.32, 0.24);
  }
  painter.box(0, 0.94, width, 0.06, {36, 34, 32});
  for (int i = -3; i <= 3; ++i) {
    const Scalar colour = i == 0 ? Scalar(50, 40, 220) : Scalar(90, 86, 84);
    painter.oval(width / 2 + 0.07 * i, 0.97, 0.02, 0.02, colour);
  }
}

void draw_desktop(Painter& painter, cv::Mat& picture) {
  const double width = painter.width();
  const bool dark = painter.random(0, 1) < 0.3;
  painter.clouds(Rect({0, 0}, picture.size()), 0.8, 0.0);
  const double left = painter.random(0.02, 0.3);
  const Scalar paper = dark ? Scalar(44, 40, 38) : Scalar(250, 250, 250);
  const Scalar ink = dark ? Scalar(200, 200, 205) : Scalar(40, 38, 36);
  const double right = width - painter.random(0.0, 0.3);
  painter.box(left, 0.05, right - left, 0.9, paper);
  painter.box(left, 0.05, right - left, 0.035, dark ? Scalar(70, 64, 60) : Scalar(214, 208, 202));
  for (double y = 0.11; y < 0.93; y += 0.022) {
    if (painter.random(0, 1) < 0.12) continue;
    double x = left + 0.03;
    const double end = right - painter.random(0.03, 0.4);
    while (x < end) {
      const double word = std::min(painter.random(0.015, 0.09), right - x);
      painter.box(x, y, word, 0.009, ink);
      x += word + 0.012;
    }
  }
  painter.box(0, 0.965, width, 0.035, dark ? Scalar(30, 30, 30) : Scalar(226, 222, 218));
  for (int i = 0; i < 8; ++i)
    painter.box(0.02 + 0.05 * i, 0.97, 0.024, 0.024, painter.random_colour(30, 230));
}

cv::Mat dark_gradient() {
  cv::Mat picture(16, 1, CV_8UC3);
  for (int row = 0; row < picture.rows; ++row) {
    const int level = 16 + 2 * row;
    picture.at<cv::Vec3b>(row, 0) = {cv::saturate_cast<uchar>(level + 14), cv::saturate_cast<uchar>(level + 4),
                                     cv::saturate_cast<uchar>(level)};
  }
  return picture;
}

}  // namespace

cv::Mat draw_screen_content(ScreenContent content, const ScreenSize& screen, std::uint64_t seed) {
  cv::Mat picture = plain(screen, Scalar::all(content == ScreenContent::white ? 255 : 0));
  Painter painter(picture, seed);
  switch (content) {
    case ScreenContent::black:
    case ScreenContent::white:
      break;
    case ScreenContent::gradient:
      return dark_gradient();
    case ScreenContent::chat:
      draw_chat(painter, picture);
      break;
    case ScreenContent::photo: {
      const double side = painter.random(0.5, 1.2);
      painter.clouds(Rect({0, 0}, picture.size()), painter.random(0.2, 0.7), side);
      break;
    }
    case ScreenContent::desktop:
      draw_desktop(painter, picture);
      break;
  }
  return picture;
}

std::string_view name_of(ScreenContent content) {
  static constexpr std::array<std::string_view, 6> names{"gradient", "black", "white", "chat", "photo", "desktop"};
  return names[static_cast<std::size_t>(content)];
}

}  // namespace telehug
