// SPDX-License-Identifier: Apache-2.0
//
// The tables of a report, each a complete <table>.
#pragma once

#include <string>
#include <vector>

#include "eval_report/report.hpp"

namespace telehug {

// What was found and how exactly, of every algorithm.
[[nodiscard]] std::string summary_table(const std::vector<ReportedAlgorithm>& algorithms);

// The same by groups, with the groups' means as multiples of those of all.
[[nodiscard]] std::string groups_table(const ReportedAlgorithm& algorithm);

// What every algorithm missed and how exact it was, beside each other, by the first one's groups.
[[nodiscard]] std::string comparison_table(const std::vector<ReportedAlgorithm>& algorithms);

// Frames without a touch in which one was found.
[[nodiscard]] std::string rests_table(const std::vector<ReportedAlgorithm>& algorithms);

[[nodiscard]] std::string calibration_table(const std::vector<CalibrationError>& errors);

// The thesis' Table 4.1: every touch, mean and standard deviation. Of more than `most` those that are farthest off, the
// farthest first, missed ones before them; means are of all.
[[nodiscard]] std::string touches_table(const std::vector<ReportedTouch>& touches, std::size_t most);

}  // namespace telehug
