// SPDX-License-Identifier: Apache-2.0
//
// What both daemons log while they work, and that the journal gets it with fields.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "doubles/journal_socket.hpp"
#include "integration/app/running_pair.hpp"
#include "service/log.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Key;
using testing::Not;
using testing::Pair;

class TheLogs : public testing::Test {
 protected:
  // A finger taps, about five times a second.
  void start_tapping() {
    pair.active_settings = {"touch.up_after_ms=0"};
    const auto tapping = pair.folder / "tapping";
    std::filesystem::create_directory(tapping);
    for (int i = 0; i < 6; ++i) {
      const char* seen = i < 3 ? "/rig2/sequence/012.jpg" : "/rig2/background.jpg";
      std::filesystem::create_symlink(std::string(TELEHUG_FIXTURES) + seen, tapping / (std::to_string(i) + ".jpg"));
    }
    pair.camera = "replay:" + tapping.string();
    pair.active_config = pair.passive_config = pair.folder.write("both.toml", "");
    pair.start_jacket();
    pair.start_passive();
    pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
    pair.start_active();
  }
  [[nodiscard]] std::uint64_t touches() const {
    return std::min(pair.counter(Side::active, "touches_published"), felt_touches());
  }
  [[nodiscard]] std::uint64_t felt_touches() const {
    const auto status = pair.status(Side::passive);
    return status.is_object() ? status.at("today").at("touches").get<std::uint64_t>() : 0;
  }
  [[nodiscard]] bool more_touches(std::uint64_t count) const {
    const std::uint64_t wanted = touches() + count;
    return eventually([&] { return touches() >= wanted; }, 120s);
  }
  [[nodiscard]] std::string log(const std::string& side) const { return content_of(pair.folder / (side + ".log")); }
  // But for those on the connection: where this PC is busy the peer is lost now and then, and that is to be told.
  [[nodiscard]] std::int64_t lines(const std::string& side) const {
    std::istringstream all(log(side));
    std::int64_t count = 0;
    for (std::string line; std::getline(all, line);) {
      const bool connection = line.find(" connected") != std::string::npos || line.find("camera ") != std::string::npos;
      count += connection ? 0 : 1;
    }
    return count;
  }

  RunningPair pair;
};

TEST_F(TheLogs, SayNothingOfAHundredTouchesUnlessTheyAreToldToAndThenTwoLinesATouch) {
  start_tapping();
  ASSERT_TRUE(more_touches(3)) << pair.logs();
  const auto active = lines("active");
  const auto passive = lines("passive");
  const auto frames = pair.counter(Side::active, "frames");
  ASSERT_TRUE(more_touches(100)) << pair.logs();
  EXPECT_EQ(lines("active"), active) << log("active");
  EXPECT_EQ(lines("passive"), passive) << log("passive");
  EXPECT_GT(pair.counter(Side::active, "frames"), frames + 400);

  pair.folder.write("both.toml", "[log]\nlevel = \"debug\"\n");
  ::kill(pair.active->pid(), SIGHUP);
  ::kill(pair.passive->pid(), SIGHUP);
  ASSERT_TRUE(eventually([this] {
    return log("active").find("debug") != std::string::npos && log("passive").find("debug") != std::string::npos;
  })) << pair.logs();
  const auto debugging = lines("passive");
  const auto before = felt_touches();
  ASSERT_TRUE(more_touches(20)) << pair.logs();
  const auto more = static_cast<std::int64_t>(felt_touches() - before);
  EXPECT_THAT(log("passive"), HasSubstr(" begins in box "));
  EXPECT_THAT(log("active"), HasSubstr(": driven"));
  EXPECT_LE(lines("passive") - debugging, 2 * more + 4) << log("passive");
}

TEST_F(TheLogs, TellAStateOnceHoweverOftenItIsLookedAt) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  const auto times = [this](const std::string& side, const std::string& text) {
    const std::string all = log(side);
    int count = 0;
    for (auto at = all.find(text); at != std::string::npos; at = all.find(text, at + 1))
      ++count;
    return count;
  };
  ASSERT_TRUE(eventually([&] { return times("active", "camera open") > 0; })) << pair.logs();
  ASSERT_EQ(pair.telehug("stop", Side::passive).code, 0);
  ASSERT_TRUE(eventually([this] { return !pair.camera_open(); })) << pair.logs();
  const auto frames = pair.counter(Side::passive, "jacket_frames_sent");
  ASSERT_TRUE(eventually([&] { return pair.counter(Side::passive, "jacket_frames_sent") > frames + 5; }));
  EXPECT_EQ(times("passive", "stopped: "), 1) << log("passive");
  EXPECT_EQ(times("passive", "jacket ready"), 1) << log("passive");
  const int losses = static_cast<int>(pair.counter(Side::active, "peer_losses"));
  EXPECT_LE(times("active", "camera open"), 1 + losses) << log("active");
  EXPECT_LE(times("active", "the other side is connected"), 1 + losses) << log("active");
}

TEST_F(TheLogs, GoToTheJournalWithWhatTheyAreAbout) {
  if (!JournalSocket::can_stand_in()) GTEST_SKIP() << "no mount namespace can be made here";
  JournalSocket journal(pair.folder / "journal");
  journal.read();
  pair.active_prefix = pair.passive_prefix = journal.prefix();
  pair.active_settings = pair.passive_settings = {"log.level=debug"};
  pair.pair_up();
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  const auto came = [&](const auto& entry) {
    return eventually([&] { return testing::Value(journal.entries(), Contains(entry)); });
  };
  // Before the stop, which closes the camera: what is over sooner than it is looked at is not told.
  EXPECT_TRUE(came(IsSupersetOf(JournalSocket::Entry{{"SYSLOG_IDENTIFIER", "telehug-active"},
                                                     {"MESSAGE_ID", std::string(message_id::camera_open)}})));
  const Outcome stopped = pair.telehug("stop", Side::passive, {"--reason", "dinner"});
  ASSERT_EQ(stopped.code, 0) << stopped.text << pair.logs();
  EXPECT_TRUE(came(IsSupersetOf(JournalSocket::Entry{{"MESSAGE", "stopped: dinner"},
                                                     {"PRIORITY", "4"},
                                                     {"SYSLOG_IDENTIFIER", "telehug-passive"},
                                                     {"TELEHUG_STAGE", "stop"},
                                                     {"MESSAGE_ID", std::string(message_id::stopped)}})));
  EXPECT_TRUE(came(IsSupersetOf(JournalSocket::Entry{{"SYSLOG_IDENTIFIER", "telehug-active"},
                                                     {"TELEHUG_STAGE", "link"},
                                                     {"TELEHUG_PEER", "Mia"},
                                                     {"MESSAGE_ID", std::string(message_id::peer_connected)}})));
  EXPECT_TRUE(came(IsSupersetOf(JournalSocket::Entry{{"SYSLOG_IDENTIFIER", "telehug-passive"},
                                                     {"TELEHUG_STAGE", "jacket"},
                                                     {"MESSAGE_ID", std::string(message_id::jacket_ready)}})));
  EXPECT_TRUE(came(AllOf(IsSupersetOf(JournalSocket::Entry{{"SYSLOG_IDENTIFIER", "telehug-passive"},
                                                           {"PRIORITY", "7"},
                                                           {"TELEHUG_STAGE", "touch"},
                                                           {"TELEHUG_PEER", "Grandma"}}),
                         Contains(Key("TELEHUG_CONTACT")))));
  EXPECT_THAT(journal.entries(), Each(AllOf(Contains(Key("MESSAGE")), Contains(Key("PRIORITY")))));
  for (const char* side : {"active", "passive"})
    EXPECT_EQ(log(side), "") << "nothing twice";
}

TEST_F(TheLogs, KeepNobodyFromStoppingEverythingWhileTheJournalHangs) {
  if (!JournalSocket::can_stand_in()) GTEST_SKIP() << "no mount namespace can be made here";
  JournalSocket journal(pair.folder / "journal");  // nobody reads it
  pair.active_prefix = pair.passive_prefix = journal.prefix();
  pair.active_settings = pair.passive_settings = {"log.level=debug"};
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  for (int round = 0; round < 20; ++round) {
    const Outcome outcome = pair.telehug(round % 2 == 0 ? "stop" : "resume", Side::passive);
    ASSERT_EQ(outcome.code, 0) << outcome.text << pair.logs();
  }
  ASSERT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
  EXPECT_TRUE(pair.ms_to_silence([this] { (void)pair.telehug("stop", Side::passive); })) << pair.logs();
  EXPECT_EQ(pair.passive->end(), 0);
}

// As in a unit that must not see the socket: then stderr takes it, as the journal's stream.
TEST_F(TheLogs, GoToTheJournalsStreamIfItsSocketIsNotThere) {
  if (!JournalSocket::can_stand_in()) GTEST_SKIP() << "no mount namespace can be made here";
  JournalSocket journal(pair.folder / "journal");
  pair.passive_prefix = journal.prefix();
  std::filesystem::remove(pair.folder / "journal");
  pair.start_passive();
  EXPECT_TRUE(eventually([this] { return log("passive").find("<6>telehug-passive ") != std::string::npos; }))
      << pair.logs();
}

}  // namespace
}  // namespace telehug
