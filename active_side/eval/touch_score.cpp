// SPDX-License-Identifier: Apache-2.0
#include "eval/touch_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace telehug {
namespace {

std::string without_number(const std::string& name) {
  const auto end = name.find_last_not_of("0123456789");
  return end == std::string::npos ? name : name.substr(0, end + 1);
}

std::string first_word(const std::string& text) {
  return text.substr(0, text.find(' '));
}

// Takes the found points that pair with these touches out of `points`.
void pair_nearest(std::vector<ScoredTouch>& touches, std::vector<ScreenPoint>& points) {
  while (!points.empty()) {
    double nearest_mm = std::numeric_limits<double>::infinity();
    std::size_t touch = 0;
    std::size_t point = 0;
    for (std::size_t t = 0; t < touches.size(); ++t) {
      for (std::size_t p = 0; p < points.size() && !touches[t].found; ++p) {
        const double apart_mm =
            std::hypot(points[p].x_mm - touches[t].place.x_mm, points[p].y_mm - touches[t].place.y_mm);
        if (apart_mm >= nearest_mm) continue;
        nearest_mm = apart_mm;
        touch = t;
        point = p;
      }
    }
    if (!std::isfinite(nearest_mm)) return;
    touches[touch].found = true;
    touches[touch].vertical_error_mm = points[point].y_mm - touches[touch].place.y_mm;
    touches[touch].horizontal_error_mm = points[point].x_mm - touches[touch].place.x_mm;
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(point));
  }
}

}  // namespace

TouchScore score_touches(const std::vector<FoundTouches>& found, const std::vector<TruthRow>& truth) {
  TouchScore score;
  for (const FoundTouches& frame : found) {
    std::vector<ScoredTouch> touches;
    const TruthRow* rest = nullptr;
    for (const TruthRow& row : truth) {
      if (row.frame != frame.frame) continue;
      if (row.contact && row.screen) {
        touches.push_back(
            {row.frame, row.tone, without_number(row.screen_picture), false, 0, 0, *row.screen, row.notes});
      } else {
        rest = &row;
      }
    }
    std::vector<ScreenPoint> points = frame.points;
    pair_nearest(touches, points);
    if (!touches.empty()) {
      for (const ScreenPoint& point : points)
        score.extras.push_back({frame.frame, point});
    } else if (rest != nullptr) {
      score.rests.push_back({rest->frame, rest->tone, without_number(rest->screen_picture), first_word(rest->notes),
                             points, rest->hover_mm, rest->notes});
    }
    score.touches.insert(score.touches.end(), touches.begin(), touches.end());
  }
  return score;
}

}  // namespace telehug
