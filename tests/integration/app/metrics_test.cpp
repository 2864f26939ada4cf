// SPDX-License-Identifier: Apache-2.0
//
// What a scraper gets of both daemons while a touch is felt, judged by the reference parser of OpenMetrics.
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "daemon/metric_table.hpp"
#include "integration/app/running_pair.hpp"
#include "integration/web/raw_browser.hpp"

namespace telehug {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Key;
using testing::StartsWith;

// Prints "NAME {LABEL=VALUE,...}\tVALUE\tTYPE" of each sample; ends with an error unless the text is OpenMetrics to the
// letter, each family with its help, its type and, if its name ends so, its unit.
constexpr const char* parser = R"(
import math, sys
from prometheus_client.openmetrics.parser import text_string_to_metric_families as parse
for family in parse(open(sys.argv[1]).read()):
  assert family.documentation.endswith('.'), family.name
  assert family.type != 'unknown', family.name
  for unit in ('seconds', 'celsius', 'volts', 'ratio'):
    assert family.name.endswith('_' + unit) == (family.unit == unit), family.name
  for s in family.samples:
    assert math.isfinite(s.value), s
    labels = ','.join(f'{key}={value}' for key, value in sorted(s.labels.items()))
    print(f'{s.name} {{{labels}}}', s.value, family.type, sep='\t')
)";

struct Sample {
  double value = 0;
  std::string type;
};
using Samples = std::map<std::string, Sample>;

class TheMetrics : public testing::Test {
 protected:
  [[nodiscard]] Samples parsed(const std::string& text) const {
    const auto file = folder.path() / "metrics.txt";
    std::ofstream(file) << text;
    const Outcome outcome = pair.run({"/usr/bin/python3", "-c", parser, file.string()});
    EXPECT_EQ(outcome.code, 0) << outcome.text << text;
    Samples samples;
    std::istringstream lines(outcome.text);
    for (std::string name, value, type;
         std::getline(lines, name, '\t') && std::getline(lines, value, '\t') && std::getline(lines, type);)
      samples[name] = {std::stod(value), type};
    return samples;
  }
  [[nodiscard]] Samples scraped(Side side) const {
    const Outcome printed = pair.telehug("metrics", side);
    EXPECT_EQ(printed.code, 0) << printed.text;
    return parsed(printed.text);
  }
  [[nodiscard]] double value(Side side, const std::string& sample) const {
    const Samples samples = scraped(side);
    const auto found = samples.find(sample);
    return found == samples.end() ? -1 : found->second.value;
  }

  RunningPair pair;
  TemporaryFolder folder;
};

TEST_F(TheMetrics, HaveEveryCounterOfTheStatusAndWhatElseIsCountedUpon) {
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
  }
  EXPECT_EQ(told, placed) << "the table has counters that no daemon tells";

  const Samples parent = scraped(Side::active);
  EXPECT_THAT(parent, Contains(Key("telehug_state {telehug_state=ok}")));
  EXPECT_TRUE(eventually([this] { return value(Side::active, "telehug_peers_connected {}") == 1; })) << pair.logs();
  for (const char* sample :
       {"telehug_frames_total {}", "telehug_touches_total {}", "telehug_touches_published_total {}",
        "telehug_stage_duration_seconds_bucket {le=+Inf,stage=camera}",
        "telehug_stage_duration_seconds_count {stage=frame_to_published}"})
    EXPECT_GT(parent.at(sample).value, 0) << sample;
  for (const char* sample : {"telehug_touches_dropped_total {cause=no_face}", "telehug_camera_losses_total {}",
                             "telehug_frames_dropped_total {cause=broken}", "telehug_peer_losses_total {}"})
    EXPECT_THAT(parent, Contains(Key(sample)));

  // A touch may have a gap where this PC is busy.
  EXPECT_TRUE(eventually([this] { return value(Side::passive, "telehug_actuators_running {}") > 0; })) << pair.logs();
  const Samples wearer = scraped(Side::passive);
  EXPECT_THAT(wearer, Contains(Key("telehug_jacket_state {telehug_jacket_state=armed}")));
  for (const char* sample : {"telehug_events_accepted_total {}", "telehug_drives_accepted_total {}",
                             "telehug_stage_duration_seconds_count {stage=event_to_link}"})
    EXPECT_GT(wearer.at(sample).value, 0) << sample;
  for (const char* sample :
       {"telehug_events_dropped_total {cause=stale}", "telehug_drives_refused_total {cause=stopped}",
        "telehug_actuators_off_total {cause=heartbeat_lost}", "telehug_actuators_off_total {cause=clock_jumped}",
        "telehug_jacket_reconnects_total {}", "telehug_actuator_duty_ratio {actuator=1}"})
    EXPECT_THAT(wearer, Contains(Key(sample)));
}

TEST_F(TheMetrics, NeverCountBackwards) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  for (const Side side : {Side::active, Side::passive}) {
    Samples before = scraped(side);
    for (int round = 0; round < 5; ++round) {
      const Samples now = scraped(side);
      for (const auto& [name, sample] : before) {
        if (sample.type == "counter" || sample.type == "histogram") {
          ASSERT_THAT(now, Contains(Key(name)));
          EXPECT_GE(now.at(name).value, sample.value) << name;
        }
      }
      before = now;
    }
  }
}

TEST_F(TheMetrics, CountWhatTurnsMotorsOffByItsCause) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  EXPECT_EQ(value(Side::passive, "telehug_actuators_off_total {cause=stop}"), 0);
  // Where this PC is busy a stop may fall into a gap of the touch.
  EXPECT_TRUE(eventually([this] {
    if (!eventually([this] { return pair.felt(); })) return false;
    if (pair.telehug("stop", Side::passive).code != 0) return false;
    const bool stopped =
        eventually([this] { return value(Side::active, "telehug_state {telehug_state=stopped}") == 1; });
    const double off = value(Side::passive, "telehug_actuators_off_total {cause=stop}");
    return pair.telehug("resume", Side::passive).code == 0 && stopped && off > 0;
  })) << pair.logs();

  ASSERT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
  const double losses = value(Side::passive, "telehug_peer_losses_total {}");
  pair.active->kill_now();
  EXPECT_TRUE(eventually([&] { return value(Side::passive, "telehug_peer_losses_total {}") > losses; })) << pair.logs();
  const Samples silent = scraped(Side::passive);
  EXPECT_GT(silent.at("telehug_actuators_off_total {cause=expired}").value +
                silent.at("telehug_actuators_off_total {cause=heartbeat_lost}").value,
            0)
      << "whichever came first";
  EXPECT_EQ(value(Side::passive, "telehug_peers_connected {}"), 0);

  const double reconnects = value(Side::passive, "telehug_jacket_reconnects_total {}");
  pair.jacket->kill_now();
  EXPECT_TRUE(eventually([this] {
    return value(Side::passive, "telehug_jacket_state {telehug_jacket_state=armed}") == 0;
  })) << pair.logs();
  pair.start_jacket();
  EXPECT_TRUE(eventually([&] { return value(Side::passive, "telehug_jacket_reconnects_total {}") > reconnects; }))
      << pair.logs();
}

TEST_F(TheMetrics, AreOnTheWebServerOnlyIfThatIsSwitchedOn) {
  const auto ask = [](const RunningPair& of, const std::string& path, const std::string& host,
                      const std::string& more = "") {
    const int port = of.status(Side::passive).at("web").at("port");
    RawBrowser scraper(static_cast<std::uint16_t>(port));
    scraper.send("GET " + path + " HTTP/1.1\r\nHost: " + host + ":" + std::to_string(port) + "\r\n" + more + "\r\n");
    return scraper.read_answer();
  };
  pair.passive_settings = {"web.metrics=true"};
  pair.start_passive();
  ASSERT_TRUE(eventually([this] { return pair.status(Side::passive).is_object(); })) << pair.logs();
  const std::string answer = ask(pair, "/metrics", "127.0.0.1");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(answer, HasSubstr("application/openmetrics-text; version=1.0.0; charset=utf-8"));
  EXPECT_THAT(parsed(answer.substr(answer.find("\r\n\r\n") + 4)), Contains(Key("telehug_problems {}")));
  EXPECT_THAT(ask(pair, "/metrics", "evil.example"), StartsWith("HTTP/1.1 4"));
  EXPECT_THAT(ask(pair, "/metrics", "127.0.0.1", "Origin: http://evil.example\r\n"), StartsWith("HTTP/1.1 4"));
  EXPECT_THAT(ask(pair, "/", "127.0.0.1"), StartsWith("HTTP/1.1 401 ")) << "it opens nothing else";

  RunningPair usual;
  usual.start_passive();
  ASSERT_TRUE(eventually([&] { return usual.status(Side::passive).is_object(); })) << usual.logs();
  EXPECT_THAT(ask(usual, "/metrics", "127.0.0.1"), StartsWith("HTTP/1.1 401 "));
}

}  // namespace
}  // namespace telehug
