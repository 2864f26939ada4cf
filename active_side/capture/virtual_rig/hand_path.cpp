// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "capture/csv_table.hpp"

namespace telehug {
namespace {

FingerPlace between(const FingerPlace& a, const FingerPlace& b, double share) {
  return {{std::lerp(a.foot.x_mm, b.foot.x_mm, share), std::lerp(a.foot.y_mm, b.foot.y_mm, share)},
          std::lerp(a.hover_mm, b.hover_mm, share)};
}

bool is_near(const ScreenPoint& p, const ScreenSize& screen) {
  return p.x_mm >= -beyond_screen_mm && p.x_mm <= screen.width_mm + beyond_screen_mm && p.y_mm >= -beyond_screen_mm &&
         p.y_mm <= screen.height_mm + beyond_screen_mm;
}

}  // namespace

Result<HandPath> read_hand_path(const std::filesystem::path& file, const ScreenSize& screen) {
  std::vector<std::string> faults;
  CsvTable table(file, {"t_s", "x_mm", "y_mm", "hover_mm"}, faults, {"second_x_mm", "second_y_mm"});
  HandPath path;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto time_s = table.number(row, 0);
    const auto x_mm = table.number(row, 1);
    const auto y_mm = table.number(row, 2);
    const auto hover_mm = table.number(row, 3);
    if (!time_s || !x_mm || !y_mm || !hover_mm) continue;
    HandPathPoint point{*time_s, {{*x_mm, *y_mm}, *hover_mm}, std::nullopt};
    if (!table.text(row, 4).empty() || !table.text(row, 5).empty()) {
      const auto second_x_mm = table.number(row, 4);
      const auto second_y_mm = table.number(row, 5);
      if (!second_x_mm || !second_y_mm) continue;
      point.second = FingerPlace{{*second_x_mm, *second_y_mm}, *hover_mm};
    }
    if (!path.empty() && !(*time_s > path.back().time_s)) table.add_fault(row, "t_s must be later than the row before");
    if (!(*hover_mm >= 0 && *hover_mm <= highest_hover_mm))
      table.add_fault(row, fmt::format("hover_mm must be 0 to {}", highest_hover_mm));
    if (!is_near(point.finger.foot, screen) || (point.second && !is_near(point.second->foot, screen)))
      table.add_fault(row, fmt::format("the place is more than {} mm beside the screen", beyond_screen_mm));
    path.push_back(point);
  }
  if (!faults.empty()) return Error{fmt::format("{}", fmt::join(faults, "\n"))};
  return path;
}

std::vector<HandPose> hands_at(const HandPath& path, double time_s) {
  const auto after = std::ranges::upper_bound(path, time_s, {}, &HandPathPoint::time_s);
  if (after == path.begin() || after == path.end()) return {};
  const HandPathPoint& a = *std::prev(after);
  const HandPathPoint& b = *after;
  const double length_s = b.time_s - a.time_s;
  const double share = (time_s - a.time_s) / length_s;
  HandPose pose;
  pose.finger = between(a.finger, b.finger, share);
  if (a.second && b.second) pose.second = between(*a.second, *b.second, share);
  pose.velocity_mm_per_s = cv::Vec3d(b.finger.foot.x_mm - a.finger.foot.x_mm, b.finger.foot.y_mm - a.finger.foot.y_mm,
                                     b.finger.hover_mm - a.finger.hover_mm) *
                           (1 / length_s);
  return {pose};
}

}  // namespace telehug
