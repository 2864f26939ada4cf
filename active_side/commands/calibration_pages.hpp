// SPDX-License-Identifier: Apache-2.0
//
// The pictures that a calibration by hand asks to be shown on the whole screen.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// Files in the folder telehug-calibration in the current one, named in the order in which they are needed, so that a
// picture viewer's key for the next one leads through them.
struct CalibrationPages {
  bool with_marks = true;

  [[nodiscard]] static std::string triangle();
  [[nodiscard]] static std::string black();
  [[nodiscard]] static std::string marks();
  [[nodiscard]] std::string dot(std::size_t touch) const;  // counted from 0

  // `points` are those to touch, in mm.
  [[nodiscard]] Status write(const ScreenSize& screen, const std::vector<ScreenPoint>& points) const;
};

}  // namespace telehug
