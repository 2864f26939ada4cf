// SPDX-License-Identifier: Apache-2.0
#include "config/quiet_hours_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

namespace telehug {
namespace {

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' '))
    text.remove_prefix(1);
  while (text.ends_with(' '))
    text.remove_suffix(1);
  return text;
}

std::optional<int> two_digits(std::string_view text) {
  if (!std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; })) return std::nullopt;
  return (text[0] - '0') * 10 + (text[1] - '0');
}

// "HH:MM" in minutes; 24:00 is one of them.
std::optional<int> minute_in(std::string_view text) {
  if (text.size() != 5 || text[2] != ':') return std::nullopt;
  const auto hour = two_digits(text.substr(0, 2));
  const auto minute = two_digits(text.substr(3, 2));
  if (!hour || !minute || *minute > 59 || *hour * 60 + *minute > minutes_of_day) return std::nullopt;
  return *hour * 60 + *minute;
}

Result<QuietSpan> span_in(std::string_view text) {
  const auto dash = text.find('-');
  const auto begin = minute_in(trimmed(text.substr(0, dash)));
  const auto end = dash == std::string_view::npos ? std::nullopt : minute_in(trimmed(text.substr(dash + 1)));
  if (!begin || !end || *begin == minutes_of_day) {
    return Error{fmt::format("\"{}\" is no span of local times: write \"20:30-07:00\", hours from 00 to 23", text)};
  }
  if (*begin == *end % minutes_of_day) {
    return Error{fmt::format("\"{}\" begins when it ends: for a whole day write \"00:00-12:00,12:00-24:00\"", text)};
  }
  return QuietSpan{*begin, *end % minutes_of_day};
}

}  // namespace

Result<QuietHours> parse_quiet_hours(std::string_view text) {
  QuietHours hours;
  if (trimmed(text).empty()) return hours;
  for (bool more = true; more;) {
    const auto comma = text.find(',');
    more = comma != std::string_view::npos;
    const auto span = span_in(trimmed(text.substr(0, comma)));
    if (!span) return span.error();
    if (hours.size() == hours.capacity()) {
      return Error{fmt::format("more than {} spans: join some of them", most_quiet_spans)};
    }
    hours.push_back(*span);
    if (more) text.remove_prefix(comma + 1);
  }
  return hours;
}

std::string time_of_day_text(int minute) {
  return fmt::format("{:02}:{:02}", minute / 60, minute % 60);
}

std::string quiet_hours_text(const QuietHours& hours) {
  std::string text;
  for (const QuietSpan& span : hours) {
    text += fmt::format("{}{}-{}", text.empty() ? "" : ",", time_of_day_text(span.begin_min),
                        time_of_day_text(span.end_min));
  }
  return text;
}

}  // namespace telehug
