// SPDX-License-Identifier: Apache-2.0
//
// What a scraper gets of both daemons while a touch is felt, judged by the reference parser of OpenMetrics.
#include <gmock/gmock.h>

#include <fstream>

#include "daemon/metric_table.hpp"
#include "integration/app/running_pair.hpp"
#include "integration/web/raw_browser.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class TheMetrics : public testing::Test {
 protected:
  // Prints "NAME LABELS VALUE" of each sample; ends with an error unless the text is OpenMetrics to the letter.
  [[nodiscard]] Outcome parsed(const std::string& text) const {
    const auto file = folder.path() / "metrics.txt";
    std::ofstream(file) << text;
    return pair.run({"/usr/bin/python3", "-c",
                     "import sys\n"
                     "from prometheus_client.openmetrics.parser import text_string_to_metric_families as parse\n"
                     "for family in parse(open(sys.argv[1]).read()):\n"
                     "  assert family.documentation, family.name\n"
                     "  for s in family.samples: print(s.name, sorted(s.labels.items()), s.value)\n",
                     file.string()});
  }

  RunningPair pair;
  TemporaryFolder folder;
};

TEST_F(TheMetrics, AreStrictOpenMetricsWithEveryCounterOfTheStatus) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  std::set<std::string> placed;
  for (const MetricRow& row : metric_table())
    for (const CounterSource& source : row.counters)
      placed.insert(std::string(source.counter));
  std::set<std::string> told;
  for (const Side side : {Side::active, Side::passive}) {
    const nlohmann::json status = pair.status(side);
    for (const auto& [counter, count] : status.at("counters").items()) {
      EXPECT_TRUE(placed.contains(counter)) << counter << " has no place in the table";
      told.insert(counter);
    }
    const Outcome printed = pair.telehug("metrics", side);
    ASSERT_EQ(printed.code, 0) << printed.text;
    const Outcome outcome = parsed(printed.text);
    ASSERT_EQ(outcome.code, 0) << outcome.text << printed.text;
    EXPECT_THAT(outcome.text, HasSubstr("telehug_state [('telehug_state', 'ok')] 1.0"));
    EXPECT_THAT(outcome.text, HasSubstr(side == Side::active ? "[('le', '+Inf'), ('stage', 'frame_to_published')]"
                                                             : "[('le', '+Inf'), ('stage', 'event_to_link')]"));
  }
  EXPECT_EQ(told, placed) << "the table has counters that no daemon tells";
}

TEST_F(TheMetrics, AreOnTheWebServerOnlyIfThatIsSwitchedOn) {
  const auto ask = [this](const std::string& host) {
    const int port = pair.status(Side::passive).at("web").at("port");
    RawBrowser scraper(static_cast<std::uint16_t>(port));
    scraper.send("GET /metrics HTTP/1.1\r\nHost: " + host + ":" + std::to_string(port) + "\r\n\r\n");
    return scraper.read_answer();
  };
  pair.passive_settings = {"web.metrics=true"};
  pair.start_passive();
  ASSERT_TRUE(eventually([this] { return pair.status(Side::passive).is_object(); })) << pair.logs();
  const std::string answer = ask("127.0.0.1");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(answer, HasSubstr("application/openmetrics-text; version=1.0.0; charset=utf-8"));
  const Outcome outcome = parsed(answer.substr(answer.find("\r\n\r\n") + 4));
  EXPECT_EQ(outcome.code, 0) << outcome.text << answer;
  EXPECT_THAT(ask("evil.example"), StartsWith("HTTP/1.1 4"));

  RunningPair usual;
  usual.start_passive();
  ASSERT_TRUE(eventually([&] { return usual.status(Side::passive).is_object(); })) << usual.logs();
  const int port = usual.status(Side::passive).at("web").at("port");
  RawBrowser scraper(static_cast<std::uint16_t>(port));
  scraper.send("GET /metrics HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
  EXPECT_THAT(scraper.read_answer(), StartsWith("HTTP/1.1 401 "));
}

}  // namespace
}  // namespace telehug
