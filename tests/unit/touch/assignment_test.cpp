// SPDX-License-Identifier: Apache-2.0
#include "touch/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace telehug {
namespace {

constexpr double alone = 60;

double cost_of(const AssignmentCosts& costs, const Assignment& assignment, std::size_t rows) {
  double sum = 0;
  for (std::size_t row = 0; row < rows; ++row)
    sum += assignment[row] == unassigned ? alone : costs[row][assignment[row]];
  return sum;
}

// Tries every way.
double least_cost(const AssignmentCosts& costs, std::size_t row, std::size_t rows, std::size_t columns,
                  unsigned taken) {
  if (row == rows) return 0;
  double least = alone + least_cost(costs, row + 1, rows, columns, taken);
  for (std::size_t c = 0; c < columns; ++c) {
    if ((taken >> c & 1U) == 0)
      least = std::min(least, costs[row][c] + least_cost(costs, row + 1, rows, columns, taken | 1U << c));
  }
  return least;
}

TEST(Assignment, IsTheCheapestOfAll) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> cost(0, 100);
  std::uniform_int_distribution<std::size_t> number(0, 5);
  for (int i = 0; i < 2000; ++i) {
    const std::size_t rows = number(random);
    const std::size_t columns = number(random);
    AssignmentCosts costs{};
    for (auto& row : costs) {
      for (double& c : row)
        c = cost(random);
    }
    const Assignment assignment = assign(costs, rows, columns, alone);
    ASSERT_NEAR(cost_of(costs, assignment, rows), least_cost(costs, 0, rows, columns, 0), 1e-9);
    std::set<std::size_t> used;
    for (std::size_t row = 0; row < rows; ++row) {
      if (assignment[row] == unassigned) continue;
      ASSERT_LT(assignment[row], columns);
      ASSERT_TRUE(used.insert(assignment[row]).second) << "a column twice";
      ASSERT_LE(costs[row][assignment[row]], alone);
    }
  }
}

TEST(Assignment, PairsTenWithTen) {
  AssignmentCosts costs{};
  for (std::size_t row = 0; row < max_contacts; ++row) {
    for (std::size_t column = 0; column < max_contacts; ++column)
      costs[row][column] = column == (row + 3) % max_contacts ? 1 : 2;
  }
  const Assignment assignment = assign(costs, max_contacts, max_contacts, alone);
  for (std::size_t row = 0; row < max_contacts; ++row)
    EXPECT_EQ(assignment[row], (row + 3) % max_contacts);
}

}  // namespace
}  // namespace telehug
