// SPDX-License-Identifier: Apache-2.0
#include "config/quiet_hours_text.hpp"

#include <gmock/gmock.h>

#include <random>
#include <string>

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(QuietHoursText, holds_spans_with_commas_between_them) {
  const auto hours = parse_quiet_hours("20:30-07:00, 13:00 - 14:15");
  ASSERT_TRUE(hours) << hours.error().message;
  EXPECT_THAT(*hours, ElementsAre(QuietSpan{1230, 420}, QuietSpan{780, 855}));
  EXPECT_EQ(quiet_hours_text(*hours), "20:30-07:00,13:00-14:15");
}

TEST(QuietHoursText, is_none_if_it_is_empty) {
  EXPECT_TRUE(parse_quiet_hours("").value().empty());
  EXPECT_TRUE(parse_quiet_hours("  ").value().empty());
  EXPECT_EQ(quiet_hours_text({}), "");
}

TEST(QuietHoursText, may_end_at_midnight) {
  EXPECT_THAT(parse_quiet_hours("22:00-24:00").value(), ElementsAre(QuietSpan{1320, 0}));
  EXPECT_THAT(parse_quiet_hours("22:00-00:00").value(), ElementsAre(QuietSpan{1320, 0}));
  EXPECT_THAT(parse_quiet_hours("00:00-12:00,12:00-24:00").value(), ElementsAre(QuietSpan{0, 720}, QuietSpan{720, 0}));
}

TEST(QuietHoursText, says_what_is_wrong_and_how_it_is_written) {
  for (const char* wrong :
       {"20:30", "20:30-", "-07:00", "8:30-07:00", "20:60-07:00", "24:00-07:00", "20:30-24:01", "20.30-07.00",
        "20:30-07:00,", ",", "20:30-07:00 13:00-14:00", "ab:cd-ef:gh", "20:3 -07:00", "+1:00-07:00"}) {
    const auto hours = parse_quiet_hours(wrong);
    ASSERT_FALSE(hours) << wrong;
    EXPECT_THAT(hours.error().message, HasSubstr("\"20:30-07:00\"")) << wrong;
  }
  EXPECT_THAT(parse_quiet_hours("07:00-07:00").error().message, HasSubstr("begins when it ends"));
  EXPECT_THAT(parse_quiet_hours("00:00-24:00").error().message, HasSubstr("00:00-12:00,12:00-24:00"));
}

TEST(QuietHoursText, holds_8_spans_at_the_most) {
  std::string text = "00:00-00:01";
  for (int n = 1; n < 8; ++n)
    text += ",00:00-00:01";
  EXPECT_EQ(parse_quiet_hours(text).value().size(), 8U);
  EXPECT_THAT(parse_quiet_hours(text + ",00:00-00:01").error().message, HasSubstr("more than 8"));
}

TEST(QuietHoursText, reads_what_it_writes) {
  std::mt19937 random(3);
  for (int round = 0; round < 1000; ++round) {
    QuietHours hours;
    for (std::size_t n = random() % 9; n > 0; --n) {
      const int begin = static_cast<int>(random() % minutes_of_day);
      hours.push_back({begin, static_cast<int>((static_cast<unsigned>(begin) + 1 + random() % 1439) % minutes_of_day)});
    }
    const auto read = parse_quiet_hours(quiet_hours_text(hours));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(*read, hours);
  }
}

TEST(QuietHoursText, bears_any_bytes) {
  std::mt19937 random(4);
  const std::string alphabet = "0123456789:-, x\xff";
  for (int round = 0; round < 20000; ++round) {
    std::string text(random() % 14, ' ');
    for (char& c : text)
      c = alphabet[random() % alphabet.size()];
    if (const auto hours = parse_quiet_hours(text)) {
      for (const QuietSpan& span : *hours) {
        EXPECT_NE(span.begin_min, span.end_min) << text;
        EXPECT_TRUE(span.begin_min >= 0 && span.begin_min < minutes_of_day) << text;
        EXPECT_TRUE(span.end_min >= 0 && span.end_min < minutes_of_day) << text;
      }
    }
  }
}

}  // namespace
}  // namespace telehug
