// SPDX-License-Identifier: Apache-2.0
#include "service/open_metrics.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace telehug {
namespace {

using testing::HasSubstr;

TEST(OpenMetricsText, NamesTypeUnitAndHelpOnceBeforeAFamilysSamples) {
  OpenMetricsText text;
  text.begin({"telehug_way_seconds", MetricType::gauge, "seconds", "How long."});
  text.sample({{"to", "a"}}, 0.25);
  text.sample({{"to", "b"}}, 3);
  EXPECT_EQ(
      std::move(text).end(),
      "# TYPE telehug_way_seconds gauge\n# UNIT telehug_way_seconds seconds\n# HELP telehug_way_seconds How long.\n"
      "telehug_way_seconds{to=\"a\"} 0.25\ntelehug_way_seconds{to=\"b\"} 3\n# EOF\n");
}

TEST(OpenMetricsText, GivesCountersAndInfosTheirSuffixes) {
  OpenMetricsText text;
  text.begin({"telehug_frames", MetricType::counter, "", "Frames."});
  text.sample({}, 12'345'678'901'234.0);
  text.begin({"telehug_build", MetricType::info, "", "Build."});
  text.sample({{"version", "1"}}, 1);
  const std::string all = std::move(text).end();
  EXPECT_THAT(all, HasSubstr("\ntelehug_frames_total 12345678901234\n"));
  EXPECT_THAT(all, HasSubstr("\ntelehug_build_info{version=\"1\"} 1\n"));
}

TEST(OpenMetricsText, LeavesOutFamiliesWithoutSamplesAndWhatIsNotFinite) {
  OpenMetricsText text;
  text.begin({"telehug_none", MetricType::gauge, "", "None."});
  text.begin({"telehug_nan", MetricType::gauge, "", "Nan."});
  text.sample({}, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(std::move(text).end(), "# EOF\n");
}

TEST(OpenMetricsText, EscapesLabels) {
  OpenMetricsText text;
  text.begin({"telehug_x", MetricType::gauge, "", "X."});
  text.sample({{"a", "q\" b\\ n\n"}}, 1);
  EXPECT_THAT(std::move(text).end(), HasSubstr("telehug_x{a=\"q\\\" b\\\\ n\\n\"} 1\n"));
}

TEST(OpenMetricsText, CountsAHistogramsRecordsUpToEachTime) {
  LatencyHistogram stage;
  stage.record(std::chrono::nanoseconds{16'383});
  stage.record(std::chrono::nanoseconds{16'384});
  stage.record(2s);
  OpenMetricsText text;
  text.begin({"telehug_stage_seconds", MetricType::histogram, "seconds", "Stage."});
  text.sample({{"stage", "s"}}, stage);
  const std::string all = std::move(text).end();
  EXPECT_THAT(all, HasSubstr("telehug_stage_seconds_bucket{stage=\"s\",le=\"0.000016383\"} 1\n"
                             "telehug_stage_seconds_bucket{stage=\"s\",le=\"0.000032767\"} 2\n"));
  EXPECT_THAT(all, HasSubstr("telehug_stage_seconds_bucket{stage=\"s\",le=\"1.073741823\"} 2\n"
                             "telehug_stage_seconds_bucket{stage=\"s\",le=\"+Inf\"} 3\n"
                             "telehug_stage_seconds_count{stage=\"s\"} 3\n"
                             "telehug_stage_seconds_sum{stage=\"s\"} 2.000032767\n"));
}

}  // namespace
}  // namespace telehug
