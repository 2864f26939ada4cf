// SPDX-License-Identifier: Apache-2.0
#include "service/log.hpp"

#include <gmock/gmock.h>

#include <cerrno>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "service/journal_sink.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;
using testing::internal::CaptureStderr;
using testing::internal::GetCapturedStderr;

TEST(Log, CarriesThePriorityForTheJournal) {
  CaptureStderr();
  set_up_log("info", LogStyle::journal);
  spdlog::error("no camera");
  spdlog::warn("late");
  spdlog::info("started");
  spdlog::debug("unseen");
  EXPECT_EQ(GetCapturedStderr(), "<3>no camera\n<4>late\n<6>started\n");
}

TEST(Log, CarriesTheTimeElsewhere) {
  CaptureStderr();
  set_up_log("debug", LogStyle::plain);
  spdlog::debug("seen");
  EXPECT_THAT(GetCapturedStderr(), testing::MatchesRegex("[0-9-]+T[0-9:.]+[+-][0-9:]+ debug   seen\n"));
}

TEST(Log, TakesAnUnknownLevelForInfo) {
  set_up_log("shouting", LogStyle::plain);
  EXPECT_EQ(spdlog::get_level(), spdlog::level::info);
}

// What the journal was sent, and what it says to it.
std::vector<std::vector<std::string>> sent;
int answer = 0;
std::mutex hangs;
const LogFields* about = nullptr;

class TheJournal : public testing::Test {
 protected:
  TheJournal() {
    sent.clear();
    answer = 0;
    about = nullptr;
    logger.emplace("journal", std::make_shared<JournalSink>(send, [] { return about; }));
  }
  static int send(const iovec* fields, int count) {
    const std::lock_guard lock(hangs);
    auto& entry = sent.emplace_back();
    for (int i = 0; i < count; ++i)
      entry.emplace_back(static_cast<const char*>(fields[i].iov_base), fields[i].iov_len);
    return answer;
  }
  // All that was logged.
  const std::vector<std::vector<std::string>>& entries() {
    logger.reset();
    return sent;
  }
  const std::string name = std::string("SYSLOG_IDENTIFIER=") + program_invocation_short_name;
  std::optional<spdlog::logger> logger;
};

TEST_F(TheJournal, HasWhatAMessageIsAboutAsFields) {
  const LogFields fields{.stage = "touch", .peer = "Mia", .contact = 0, .message_id = message_id::stopped};
  about = &fields;
  logger->warn("two\nlines");
  EXPECT_THAT(entries(), ElementsAre(UnorderedElementsAre(
                             "MESSAGE=two\nlines", "PRIORITY=4", name, "TELEHUG_STAGE=touch", "TELEHUG_PEER=Mia",
                             "TELEHUG_CONTACT=0", "MESSAGE_ID=" + std::string(message_id::stopped))));
}

TEST_F(TheJournal, HasNoFieldOfWhatAMessageIsNotAbout) {
  logger->info("plain");
  logger->log(spdlog::source_loc{"a.cpp", 7, "f"}, spdlog::level::err, "where");
  EXPECT_THAT(entries(), ElementsAre(UnorderedElementsAre("MESSAGE=plain", "PRIORITY=6", name),
                                     UnorderedElementsAre("MESSAGE=where", "PRIORITY=3", name, "CODE_FILE=a.cpp",
                                                          "CODE_LINE=7", "CODE_FUNC=f")));
}

TEST_F(TheJournal, GivesStderrWhatItDoesNotTake) {
  CaptureStderr();
  answer = -ENOBUFS;
  logger->error("no camera");
  (void)entries();
  EXPECT_EQ(GetCapturedStderr(), "<3>no camera\n");
}

TEST_F(TheJournal, HoldsNobodyUpWhileItHangsAndTellsHowMuchItMissed) {
  hangs.lock();
  logger->info("first");
  const std::size_t many = JournalSink::most_waiting + 50;
  for (std::size_t i = 0; i < many; ++i)
    logger->info("more");
  hangs.unlock();
  const auto& came = entries();
  ASSERT_FALSE(came.empty());
  // The first may have been on its way, or have waited with the others.
  const std::size_t taken = came.size() - 1;
  EXPECT_THAT(taken, testing::AnyOf(JournalSink::most_waiting, JournalSink::most_waiting + 1));
  EXPECT_THAT(came.front(), testing::Contains("MESSAGE=first"));
  EXPECT_THAT(came.back(), testing::Contains("MESSAGE=" + std::to_string(many + 1 - taken) +
                                             " messages were left out: the journal did not take them in time"));
}

TEST(LogMessages, HaveAnIdEachThatIsOne) {
  const std::vector<std::string_view> all{message_id::stopped,
                                          message_id::resumed,
                                          message_id::configuration_taken,
                                          message_id::configuration_refused,
                                          message_id::peer_connected,
                                          message_id::peer_absent,
                                          message_id::jacket_ready,
                                          message_id::jacket_absent,
                                          message_id::camera_open,
                                          message_id::camera_lost};
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), all.size());
  for (const std::string_view id : all)
    EXPECT_TRUE(id.size() == 32 && id.find_first_not_of("0123456789abcdef") == std::string_view::npos) << id;
}

TEST(SayOnChange, LogsAStateOnceUntilItChanges) {
  CaptureStderr();
  set_up_log("info", LogStyle::journal);
  SayOnChange camera;
  camera.say(spdlog::level::warn, "no camera");
  camera.say(spdlog::level::warn, "no camera");
  camera.say(spdlog::level::info, "camera {} back");
  camera.forget();
  camera.say(spdlog::level::info, "camera {} back");
  EXPECT_EQ(GetCapturedStderr(), "<4>no camera\n<6>camera {} back\n<6>camera {} back\n");
}

}  // namespace
}  // namespace telehug
