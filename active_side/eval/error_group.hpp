// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "eval/touch_score.hpp"

namespace telehug {

// Touches that have something in common, and the frames without a touch.
struct ErrorGroup {
  std::size_t touches = 0;
  std::size_t found = 0;
  std::vector<double> vertical_mm;  // sizes of the errors of the near ones
  std::vector<double> horizontal_mm;
  std::vector<double> all_vertical_mm;  // of all found ones
  std::vector<double> all_horizontal_mm;
  std::size_t rests = 0;
  std::size_t rests_touched = 0;

  [[nodiscard]] std::size_t missed() const { return touches - found; }
  [[nodiscard]] std::size_t near() const { return vertical_mm.size(); }
  [[nodiscard]] std::size_t far() const { return found - near(); }

  void add(const ScoredTouch& touch);
  void add(const ScoredRest& rest);
};

using ErrorGroups = std::map<std::string, ErrorGroup>;  // by what they have in common, as in "tone II"

// What a touch has in common with others: tone, screen, and what its notes tell of nails, polish, ring, glove and
// hands.
[[nodiscard]] std::vector<std::string> groups_of(const ScoredTouch& touch);
[[nodiscard]] std::vector<std::string> groups_of(const ScoredRest& rest);

[[nodiscard]] ErrorGroup whole(const TouchScore& score);

// Adds what was found to each of its own groups and to `common` ones, that all of it belongs to.
void add(ErrorGroups& groups, const TouchScore& score, const std::vector<std::string>& common = {});

// Without those whose kind ("tone" in "tone II") has no other group: they would say what all together say.
[[nodiscard]] ErrorGroups groups_that_differ(const ErrorGroups& groups);

}  // namespace telehug
