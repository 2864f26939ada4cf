// SPDX-License-Identifier: Apache-2.0
//
// The Hungarian method with potentials: rows are added one by one, each along the cheapest augmenting path.
#include "touch/assignment.hpp"

#include <limits>

namespace telehug {

Assignment assign(const AssignmentCosts& costs, std::size_t rows, std::size_t columns, double alone) {
  // Every row has a column of its own beside the real ones in which it stays alone. Index 0 is the path's start.
  constexpr std::size_t most = 2 * max_contacts + 1;
  const std::size_t all = columns + rows;
  std::array<double, max_contacts + 1> row_potential{};
  std::array<double, most> column_potential{};
  std::array<std::size_t, most> row_of{};
  std::array<std::size_t, most> before{};
  for (std::size_t row = 1; row <= rows; ++row) {
    std::array<double, most> least{};
    least.fill(std::numeric_limits<double>::infinity());
    std::array<bool, most> done{};
    row_of[0] = row;
    std::size_t column = 0;
    while (row_of[column] != 0) {
      done[column] = true;
      const std::size_t from = row_of[column];
      std::size_t next = 0;
      double delta = std::numeric_limits<double>::infinity();
      for (std::size_t c = 1; c <= all; ++c) {
        if (done[c]) continue;
        const double cost = c <= columns ? costs[from - 1][c - 1] : alone;
        const double reduced = cost - row_potential[from] - column_potential[c];
        if (reduced < least[c]) {
          least[c] = reduced;
          before[c] = column;
        }
        if (least[c] < delta) {
          delta = least[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= all; ++c) {
        if (done[c]) {
          row_potential[row_of[c]] += delta;
          column_potential[c] -= delta;
        } else {
          least[c] -= delta;
        }
      }
      column = next;
    }
    for (; column != 0; column = before[column])
      row_of[column] = row_of[before[column]];
  }
  Assignment assignment;
  assignment.fill(unassigned);
  for (std::size_t c = 1; c <= columns; ++c) {
    if (row_of[c] != 0 && costs[row_of[c] - 1][c - 1] <= alone) assignment[row_of[c] - 1] = c - 1;
  }
  return assignment;
}

}  // namespace telehug
