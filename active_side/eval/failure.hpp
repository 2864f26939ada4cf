// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/units.hpp"
#include "eval/touch_score.hpp"

namespace telehug {

enum class FailureKind { missed, far, false_touch };

// Something that an algorithm did wrong in a frame.
struct Failure {
  FailureKind kind = FailureKind::missed;
  std::string frame;
  std::string what;    // for a person: "116.1 mm off; tone II, screen chat, touch ring"
  double size_mm = 0;  // far: how far; false touches: from how high, or much where nobody is; missed: 0
  std::optional<ScreenPoint> place = {};  // where it really was
  std::optional<ScreenPoint> found = {};
};

[[nodiscard]] std::vector<Failure> failures_of(const TouchScore& score);

}  // namespace telehug
