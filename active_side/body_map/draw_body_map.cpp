// SPDX-License-Identifier: Apache-2.0
#include "body_map/draw_body_map.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "body_map/vitruvian_grid.hpp"

namespace telehug {
namespace {

const cv::Scalar yellow(0, 255, 255);
const cv::Scalar red(0, 0, 255);
const cv::Scalar white(255, 255, 255);
const cv::Scalar black(0, 0, 0);
constexpr double fill_opacity = 0.45;

cv::Rect rounded(const cv::Rect2d& rect) {
  const cv::Point top_left(cvRound(rect.x), cvRound(rect.y));
  const cv::Point bottom_right(cvRound(rect.x + rect.width), cvRound(rect.y + rect.height));
  return {top_left, bottom_right};
}

void fill(cv::Mat& bgr, const cv::Rect& box) {
  const cv::Rect visible = box & cv::Rect(cv::Point(), bgr.size());
  if (visible.empty()) {
    return;
  }
  cv::Mat part = bgr(visible);
  const cv::Mat colour(part.size(), part.type(), red);
  cv::addWeighted(colour, fill_opacity, part, 1 - fill_opacity, 0, part);
}

// In the middle of the box, as large as fits; the outline keeps it readable on any picture. A row that is cut so low
// that no number can be read gets none.
void write_number(cv::Mat& bgr, const cv::Rect& box, int number, const cv::Scalar& colour, const cv::Scalar& outline) {
  constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
  constexpr double px_at_scale_1 = 22;
  constexpr double least_scale = 0.3;
  const std::string text = std::to_string(number);
  const double scale = std::min(box.width, box.height) / px_at_scale_1 * 0.35;
  if (scale < least_scale) {
    return;
  }
  const int line_px = std::max(1, cvRound(scale * 1.5));
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, font, scale, line_px, &baseline);
  const cv::Point start(box.x + (box.width - size.width) / 2, box.y + (box.height + size.height) / 2);
  cv::putText(bgr, text, start, font, scale, outline, line_px + 2, cv::LINE_AA);
  cv::putText(bgr, text, start, font, scale, colour, line_px, cv::LINE_AA);
}

}  // namespace

cv::Mat draw_body_map(const cv::Mat& bgr, const BodyMap& map, const ScreenScale& scale, std::uint16_t touched) {
  cv::Mat drawn = bgr.clone();
  const int line_px = std::max(1, bgr.rows / 400);
  if (const auto box = box_rect(map, touched)) {
    fill(drawn, rounded(scale.to_px(*box)));
  }
  const int boxes = map.shape.columns * map.shape.rows;
  for (int number = 1; number <= boxes; ++number) {
    if (const auto box = box_rect(map, static_cast<std::uint16_t>(number))) {
      const cv::Rect place = rounded(scale.to_px(*box));
      cv::rectangle(drawn, place, red, line_px);
      if (number == touched) {
        write_number(drawn, place, number, white, black);
      } else {
        write_number(drawn, place, number, red, white);
      }
    }
  }
  cv::rectangle(drawn, rounded(scale.to_px(map.face)), yellow, line_px + 1);
  return drawn;
}

}  // namespace telehug
