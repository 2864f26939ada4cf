// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace telehug {

// Columns of the finger at the border: [first, end).
struct FingerColumns {
  int first = 0;
  int end = 0;
  [[nodiscard]] int width() const noexcept { return end - first; }
};

// The thesis' search for the two edges of a finger in the red channel along the border: the two largest differences
// between the means of neighbouring groups of 10 columns, at least 20 px apart; each refined within 30 columns around
// it with groups of 3. The thesis looks at the size of a difference, not at its sign: a finger may be darker or
// brighter than the bezel.
class FingerEdgeFinder {
 public:
  static constexpr int group_columns = 10;
  static constexpr int refined_group_columns = 3;
  static constexpr int refined_within_columns = 30;
  static constexpr int least_width_px = 20;

  // `least_step`: grey levels below which a difference is no edge; see ThesisOptions.
  FingerEdgeFinder(int columns, double least_step);

  // `red`: mean red of each column. Nothing if there are no two edges.
  std::optional<FingerColumns> find(std::span<const float> red);

 private:
  double least_step_;
  std::vector<float> step_;  // between group i-1 and group i, absolute
};

}  // namespace telehug
