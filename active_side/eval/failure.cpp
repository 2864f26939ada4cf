// SPDX-License-Identifier: Apache-2.0
#include "eval/failure.hpp"

#include <fmt/format.h>

namespace telehug {
namespace {

constexpr double nobody_there_mm = 1000;

template <typename Scored>
std::string circumstances(const Scored& scored) {
  std::string text;
  if (!scored.tone.empty()) text += fmt::format("tone {}, ", scored.tone);
  if (!scored.screen.empty()) text += fmt::format("screen {}, ", scored.screen);
  return text + scored.notes;
}

}  // namespace

std::vector<Failure> failures_of(const TouchScore& score) {
  std::vector<Failure> failures;
  for (const ScoredTouch& touch : score.touches) {
    if (!touch.found) {
      failures.push_back({FailureKind::missed, touch.frame, circumstances(touch), 0, touch.place, std::nullopt});
    } else if (!touch.near()) {
      failures.push_back({FailureKind::far, touch.frame,
                          fmt::format("{:.1f} mm off; {}", touch.error_mm(), circumstances(touch)), touch.error_mm(),
                          touch.place, touch.found_place()});
    }
  }
  for (const ScoredRest& rest : score.rests) {
    const std::string what =
        "nothing touches" + (rest.hover_mm ? fmt::format(", {:.0f} mm above; ", *rest.hover_mm) : "; ");
    for (const ScreenPoint& point : rest.false_touches) {
      failures.push_back({FailureKind::false_touch, rest.frame, what + circumstances(rest),
                          rest.hover_mm.value_or(nobody_there_mm), std::nullopt, point});
    }
  }
  for (const ExtraTouch& extra : score.extras)
    failures.push_back({FailureKind::false_touch, extra.frame, "beside a real touch", 0, std::nullopt, extra.place});
  return failures;
}

}  // namespace telehug
