// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstddef>

namespace telehug {

inline constexpr int minutes_of_day = 24 * 60;

// Local times of day, in minutes since midnight, 0..minutes_of_day - 1. An end before its begin is the next morning's.
struct QuietSpan {
  int begin_min = 0;
  int end_min = 0;  // no longer quiet; never begin_min
  friend bool operator==(const QuietSpan&, const QuietSpan&) = default;
};

inline constexpr std::size_t most_quiet_spans = 8;
using QuietHours = boost::container::static_vector<QuietSpan, most_quiet_spans>;

}  // namespace telehug
