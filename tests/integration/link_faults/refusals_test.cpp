// SPDX-License-Identifier: Apache-2.0
//
// Who is refused between two homes, and what both sides say then: the wearer's side is always the real daemon, the
// other one too unless it would not even start. The table shows it.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <system_error>

#include "doubles/child_program.hpp"
#include "doubles/crafted_pair.hpp"
#include "integration/link_faults/faulty_link.hpp"
#include "service/exit_code.hpp"
#include "wall_clock/shifted_wall_clock.hpp"

namespace telehug {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

constexpr auto day = std::chrono::hours(24);
constexpr const char* id = "0123456789abcdef";
// Longer than anybody may take for a handshake, and than the first participant is kept while nobody is heard.
constexpr Duration long_enough = 6s;

struct Row {
  std::string who;
  std::string wearers_side;
  std::string other_side;
};

class Refusals : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    try {
      link = std::make_unique<FaultyLink>(FaultyLink::Pairing::left_to_the_test);
      link->pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
      link->pair.start_jacket();
    } catch (const std::system_error& error) {
      why_not = error.what();
    }
  }
  static void TearDownTestSuite() {
    link.reset();
    if (!testing::UnitTest::GetInstance()->Failed())
      fmt::print("\nIn none of these cases anything was felt, and no daemon ended but where its pair did.\n");
    for (const Row& row : rows)
      fmt::print("{}\n  wearer's side: {}\n  other side:    {}\n", row.who, row.wearers_side, row.other_side);
    rows.clear();
  }
  void SetUp() override {
    if (!link) GTEST_SKIP() << "network namespaces are not permitted here: " << why_not;
    for (const Side side : {Side::active, Side::passive})
      std::filesystem::remove_all(store(side));
  }
  void TearDown() override {
    if (!link) return;
    link->pair.active.reset();
    link->pair.passive.reset();
    link->pair.active_prefix.clear();
    for (const char* log : {"active.log", "passive.log"})
      std::filesystem::remove(link->pair.folder / log);
  }

  static std::filesystem::path store(Side side) {
    return link->pair.folder / (side == Side::active ? "pairs-active" : "pairs-passive");
  }
  static void start_wearers_side() {
    link->start_passive();
    ASSERT_TRUE(eventually([] { return link->pair.jacket_state() == "armed"; })) << link->pair.logs();
  }
  // Both daemons feel and are felt until the pair is revoked on that side alone, whose daemon then ends, and the other
  // one says why. How long after that the jacket was silent.
  static std::optional<double> ms_to_silence_after_revoking(Side side) {
    const CraftedPair own(id);
    own.keep(store(Side::passive), Side::passive);
    own.keep(store(Side::active), Side::active);
    start_wearers_side();
    link->start_active();
    EXPECT_TRUE(eventually([] { return link->pair.felt(); })) << link->pair.logs();
    const auto silent_ms = link->pair.ms_to_silence([side] { link->pair.pairs(side).revoke(id); });
    EXPECT_LE(silent_ms.value_or(0), 600);
    ChildProcess& daemon = side == Side::active ? *link->pair.active : *link->pair.passive;
    EXPECT_TRUE(eventually([&] { return !daemon.runs(); })) << link->pair.logs();
    EXPECT_EQ(daemon.end(), to_int(ExitCode::pair_ended));
    const Side other = side == Side::active ? Side::passive : Side::active;
    EXPECT_TRUE(eventually([other] { return says(other).find("revoked on the other PC") != std::string::npos; }))
        << link->pair.logs();
    return silent_ms;
  }
  // Of the parent's home.
  static std::unique_ptr<ChildProgram> start_sender(const std::vector<std::string>& options = {},
                                                    const std::vector<std::string>& prefix = {}) {
    std::vector<std::string> command = prefix;
    command.insert(command.end(), {TELEHUG_PURPOSE_MADE_SENDER, "--domain", std::to_string(link->pair.domain()),
                                   "--store", store(Side::active), "--id", id});
    command.insert(command.end(), options.begin(), options.end());
    const InsideNamespace inside(link->homes.network(Home::parent));
    return std::make_unique<ChildProgram>(command);
  }

  // What a side says about the peer.
  static std::string says(Side side) {
    const auto status = link->pair.status(side);
    if (!status.is_object()) return "nothing: it does not run";
    for (const auto& problem : status["problems"]) {
      const std::string what = problem["what"];
      if (what.starts_with("no peer")) return what + " -> " + problem["do"].get<std::string>();
    }
    return "a peer is connected";
  }
  static void expect_nothing_felt() {
    EXPECT_FALSE(eventually([] { return link->pair.felt(); }, long_enough)) << link->pair.logs();
    EXPECT_TRUE(link->pair.passive->runs()) << link->pair.logs();
  }
  // It was refused for what it is, and nothing is broken by it.
  static void expect_the_right_one_is_felt(const CraftedPair& pair) {
    link->pair.active.reset();
    std::filesystem::remove_all(store(Side::active));
    pair.keep(store(Side::active), Side::active);
    const auto sender = start_sender();
    EXPECT_TRUE(eventually([] { return link->pair.felt(); })) << link->pair.logs();
  }
  // Of a telehug-active that does not start.
  static std::string start_of(const Outcome& refused) {
    std::string text = refused.text;
    std::ranges::replace(text, '\n', ' ');
    return "telehug-active does not start: " + text;
  }
  static void note(const std::string& who, const std::string& others) {
    rows.push_back({who, says(Side::passive), others});
  }

  static std::unique_ptr<FaultyLink> link;
  static std::string why_not;
  static std::vector<Row> rows;
};

std::unique_ptr<FaultyLink> Refusals::link;
std::string Refusals::why_not;
std::vector<Row> Refusals::rows;

constexpr const char* belongs_not = "tried to connect without belonging to this pair";
constexpr const char* without_end = "comes to no end";

TEST_F(Refusals, APairOfAnotherWearerWithTheSameIdIsNotFeltAndBothSidesSaySo) {
  const CraftedPair own(id);
  const CraftedPair strange(id);
  own.keep(store(Side::passive), Side::passive);
  strange.keep(store(Side::active), Side::active);
  start_wearers_side();
  link->start_active();
  expect_nothing_felt();
  EXPECT_THAT(says(Side::passive), AnyOf(HasSubstr(belongs_not), HasSubstr(without_end))) << link->pair.logs();
  EXPECT_THAT(says(Side::active), AnyOf(HasSubstr(belongs_not), HasSubstr(without_end))) << link->pair.logs();
  note("telehug-active with another wearer's pair of the same id and partition", says(Side::active));
  expect_the_right_one_is_felt(own);
}

TEST_F(Refusals, SomebodyWithoutACertificateIsNotFeltAndTheWearersSideSaysSo) {
  const CraftedPair own(id);
  own.keep(store(Side::passive), Side::passive);
  start_wearers_side();
  const auto sender = start_sender({"--plain"});
  expect_nothing_felt();
  EXPECT_THAT(says(Side::passive), HasSubstr(std::string("10.77.0.1 ") + belongs_not)) << link->pair.logs();
  note("a sender without DDS Security in the pair's partition", "(no daemon: without a pair it uses loopback alone)");
  sender->end();
  expect_the_right_one_is_felt(own);
}

TEST_F(Refusals, AnExpiredCertificateIsNotFeltNotEvenOfASideWhoseClockIsBehind) {
  const CraftedPair own(id);
  own.keep(store(Side::passive), Side::passive);
  const Validity over{wall_time() - 10 * day, wall_time() - 1 * day};
  own.keep(store(Side::active), Side::active, {.certificate = over, .permissions = over});
  const Outcome refused = link->run(Home::parent, link->pair.active_command());
  EXPECT_EQ(refused.code, to_int(ExitCode::pair_ended)) << refused.text;
  EXPECT_THAT(refused.text, HasSubstr("it has expired on"));

  start_wearers_side();
  ShiftedWallClock clock(link->pair.folder / "parents-clock");
  clock.shift(-2 * day);
  link->pair.active_prefix = clock.prefix();
  link->start_active();
  expect_nothing_felt();
  EXPECT_THAT(says(Side::passive), AnyOf(HasSubstr(belongs_not), HasSubstr(without_end))) << link->pair.logs();
  EXPECT_THAT(says(Side::active), AnyOf(HasSubstr(belongs_not), HasSubstr(without_end))) << link->pair.logs();
  rows.push_back({"telehug-active whose certificate has expired", "(nobody comes)", start_of(refused)});
  note("telehug-active whose certificate has expired, its clock two days behind", says(Side::active));
  expect_the_right_one_is_felt(own);
}

TEST_F(Refusals, ExpiredPermissionsAreNotFelt) {
  const CraftedPair own(id);
  own.keep(store(Side::passive), Side::passive);
  own.keep(store(Side::active), Side::active, {.permissions = {wall_time() - 10 * day, wall_time() - 1 * day}});
  const Outcome refused = link->run(Home::parent, link->pair.active_command());
  EXPECT_EQ(refused.code, to_int(ExitCode::pair_ended)) << refused.text;

  start_wearers_side();
  ShiftedWallClock clock(link->pair.folder / "parents-clock");
  clock.shift(-2 * day);
  const auto sender = start_sender({}, clock.prefix());
  expect_nothing_felt();
  EXPECT_THAT(says(Side::passive), AnyOf(HasSubstr(belongs_not), HasSubstr(without_end))) << link->pair.logs();
  note("a sender whose permissions alone have expired, its clock two days behind", start_of(refused));
  sender->end();
  expect_the_right_one_is_felt(own);
}

TEST_F(Refusals, PermissionsWithoutTheTouchTopicLetEverythingThroughButTouches) {
  const CraftedPair own(id);
  own.keep(store(Side::passive), Side::passive);
  const auto without_touch = [](std::string document) {
    const std::string topic = "            <topic>telehug/v1/active/touch</topic>\n";
    return document.erase(document.find(topic), topic.size());
  };
  own.keep(store(Side::active), Side::active, {.permitted = without_touch});
  const Outcome refused = link->run(Home::parent, link->pair.active_command());
  EXPECT_EQ(refused.code, to_int(ExitCode::config)) << refused.text;
  EXPECT_THAT(refused.text, HasSubstr("it does not permit"));

  start_wearers_side();
  // Its own Fast DDS would not let it write touches; this one's does.
  const auto sender = start_sender();
  EXPECT_EQ(sender->read_line(), "heard");
  expect_nothing_felt();
  EXPECT_EQ(says(Side::passive), "a peer is connected") << link->pair.logs();
  EXPECT_EQ(link->pair.counter(Side::passive, "events_received"), 0U);
  note("a sender whose permissions lack the touches, its own check taken out", start_of(refused));
  sender->end();
  expect_the_right_one_is_felt(own);
}

TEST_F(Refusals, APairRevokedOnTheWearersSideAloneIsOverAndBothSidesSaySo) {
  const auto silent_ms = ms_to_silence_after_revoking(Side::passive);
  ASSERT_TRUE(silent_ms) << link->pair.logs();
  rows.push_back({fmt::format("a pair revoked on the wearer's side (silent after {:.0f} ms)", *silent_ms),
                  "ends, exit code 15: the pair with Grandma was revoked on this PC", says(Side::active)});
  start_wearers_side();
  expect_nothing_felt();
  EXPECT_THAT(says(Side::passive), HasSubstr("has no pair"));
  note("the same, telehug-passive started again", says(Side::active));
}

TEST_F(Refusals, APairRevokedOnTheSendersSideAloneIsOverAndBothSidesSaySo) {
  const auto silent_ms = ms_to_silence_after_revoking(Side::active);
  ASSERT_TRUE(silent_ms) << link->pair.logs();
  note(fmt::format("a pair revoked on the sender's side (silent after {:.0f} ms)", *silent_ms),
       "ends, exit code 15: the pair with Mia was revoked on this PC");
  link->start_active();
  expect_nothing_felt();
  EXPECT_THAT(says(Side::active), HasSubstr("has no pair"));
  note("the same, telehug-active started again", says(Side::active));
}

TEST_F(Refusals, RecordedPacketsAreNotFeltAndTheWearersSideSaysThatSomebodyIsThere) {
  const CraftedPair own(id);
  own.keep(store(Side::passive), Side::passive);
  own.keep(store(Side::active), Side::active);
  start_wearers_side();
  link->homes.record(Home::parent);
  auto sender = start_sender();
  ASSERT_TRUE(eventually([] { return link->pair.felt(); })) << link->pair.logs();
  const auto packets = link->homes.take_recording(Home::parent);
  sender->end();
  ASSERT_TRUE(eventually([] { return !link->pair.felt(); })) << link->pair.logs();
  link->homes.replay(Home::parent, packets);
  expect_nothing_felt();
  note("all packets of a sender replayed after its end", "(no daemon)");
  start_wearers_side();
  link->homes.replay(Home::parent, packets);
  expect_nothing_felt();
  note("the same to a telehug-passive that was started anew", "(no daemon)");
  expect_the_right_one_is_felt(own);
}

}  // namespace
}  // namespace telehug
