// SPDX-License-Identifier: Apache-2.0
#include "setup/solve_setup.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "detection/touch_calibration.hpp"

namespace telehug {
namespace {

struct Solved {
  BorderLine border;
  std::variant<ThesisCalibration, RigCalibration> model;
};

Result<Solved> solve_thesis(const EmptyScreen& seen, const DotTouches& dots) {
  const std::array<MeasuredTouch, 2> touches{dots.measured(0), dots.measured(1)};
  const auto model = ThesisTouchModel::solve(seen.screen, touches[0], touches[1]);
  if (!model) return model.error();
  return Solved{seen.border.line, ThesisCalibration{touches, *model}};
}

Result<Solved> solve_rig(const EmptyScreen& seen, const DotTouches& dots) {
  CalibrationPictures pictures{seen.screen, seen.black, seen.triangle, std::nullopt, {}};
  if (!seen.cameras.empty()) pictures.marks = seen.marks;
  const std::vector<bool> taken = dots.taken();
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i]) pictures.touches.push_back({dots.picture(i), dots.dots()[i]});
  }
  auto solved = calibrate_with_pictures(pictures);
  if (!solved) return solved.error();
  const BorderLine edge = border_line(solved->solution.model.camera, seen.screen);
  return Solved{edge, *std::move(solved)};
}

}  // namespace

Result<Calibration> solve_setup(const EmptyScreen& seen, const DotTouches& dots, bool thesis, const std::string& camera,
                                const std::string& date) {
  auto solved = thesis ? solve_thesis(seen, dots) : solve_rig(seen, dots);
  if (!solved) return solved.error();
  const ImageSize image{seen.black.cols, seen.black.rows};
  return Calibration{camera, date, image, seen.screen, solved->border, std::move(solved->model)};
}

}  // namespace telehug
