// SPDX-License-Identifier: Apache-2.0
#include "daemon/kept_stop.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <future>
#include <sstream>

#include "daemon/stop_switch.hpp"
#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class KeptStop : public testing::Test {
 protected:
  [[nodiscard]] std::string content() const {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  [[nodiscard]] bool is_there() const { return std::filesystem::exists(file); }
  // Nothing can be written below a file, not even by root.
  void block() const { folder.write("state", ""); }
  void unblock() const { std::filesystem::remove(folder / "state"); }

  TemporaryFolder folder;
  std::filesystem::path file = folder / "state" / "stop-passive.json";
  FakeClock clock;
};

TEST_F(KeptStop, IsReadAsItWasKeptByNobodyButItsOwner) {
  EXPECT_EQ(read_kept_stop(file).value(), std::nullopt) << "there is no file";
  ASSERT_TRUE(keep_stop(file, "dinner \u00e4"));
  EXPECT_EQ(read_kept_stop(file).value(), "dinner \u00e4");
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  ASSERT_TRUE(keep_stop(file, "bed")) << "over the one before";
  EXPECT_EQ(read_kept_stop(file).value(), "bed");
  ASSERT_TRUE(keep_stop(file, std::nullopt));
  EXPECT_FALSE(is_there());
  EXPECT_TRUE(keep_stop(file, std::nullopt)) << "and again";
}

TEST_F(KeptStop, IsAnErrorUnlessItIsWhatWasWritten) {
  for (const char* text :
       {"", "{", "[]", "{}", R"({"format":1})", R"({"format":2,"reason":"x"})", R"({"format":1,"reason":5})",
        R"({"format":1,"reason":"x","more":1})", R"({"reason":"x"})", "{\"format\":1,\"reason\":\"\xff\"}"}) {
    EXPECT_FALSE(parse_kept_stop(text)) << text;
  }
  ASSERT_TRUE(keep_stop(file, "dinner"));
  const std::string whole = content();
  for (std::size_t size = 0; size + 2 < whole.size(); ++size)
    EXPECT_FALSE(parse_kept_stop(whole.substr(0, size))) << "cut off after " << size;
  EXPECT_EQ(parse_kept_stop(whole).value(), "dinner");
}

TEST_F(KeptStop, HoldsInTheNextRunUntilItIsResumed) {
  {
    StopSwitch stop(file);
    EXPECT_FALSE(stop.stopped());
    stop.stop({{"reason", "dinner"}});
    stop.keep(clock.now());
  }
  {
    StopSwitch stop(file);
    EXPECT_TRUE(stop.stopped());
    EXPECT_EQ(stop.reason(), "dinner");
    EXPECT_TRUE(stop.problem().is_null());
    stop.resume();
    stop.keep(clock.now());
  }
  EXPECT_FALSE(is_there());
  EXPECT_FALSE(StopSwitch(file).stopped());
}

TEST_F(KeptStop, OfAButtonIsLeftToHousekeeping) {
  StopSwitch stop(file);
  stop.hold("the emergency stop button was pressed", "it is pressed");
  EXPECT_FALSE(is_there()) << "the thread of the button waits for no disk";
  stop.keep(clock.now());
  EXPECT_EQ(StopSwitch(file).reason(), "the emergency stop button was pressed");
}

TEST_F(KeptStop, IsInTheFileBeforeTheLocalSocketAnswers) {
  StopSwitch stop(file);
  ControlServer server({.socket = folder / "a.sock", .group = {}, .most_clients = 4});
  stop.serve(server);
  server.start();
  const auto ask = [&server](json request) {
    std::promise<json> answer;
    server.ask(std::move(request), [&answer](json given) { answer.set_value(std::move(given)); });
    return answer.get_future().get();
  };
  EXPECT_EQ(ask({{"command", "stop"}, {"reason", "dinner"}}), (json{{"stopped", true}}));
  EXPECT_EQ(read_kept_stop(file).value(), "dinner");
  EXPECT_EQ(ask({{"command", "resume"}}), (json{{"stopped", false}}));
  EXPECT_FALSE(is_there());
}

TEST_F(KeptStop, MeansStoppedIfItCannotBeReadAndIsMendedByAResume) {
  folder.write("state/stop-passive.json", "{\"format\":1,\"rea");
  StopSwitch stop(file);
  EXPECT_TRUE(stop.stopped());
  EXPECT_EQ(stop.reason(), "nobody knows whether it was stopped before the restart");
  EXPECT_THAT(stop.problem().at("what"), HasSubstr("stop-passive.json is damaged"));
  EXPECT_EQ(stop.problem().at("do"), "`telehug resume` begins anew");
  stop.keep(clock.now());
  EXPECT_EQ(content(), "{\"format\":1,\"rea") << "nobody has resumed";
  stop.resume();
  stop.keep(clock.now());
  EXPECT_TRUE(stop.problem().is_null());
  EXPECT_FALSE(StopSwitch(file).stopped());
}

TEST_F(KeptStop, StopsAllTheSameWhereItCannotBeWrittenAndSaysSoUntilItCan) {
  block();
  StopSwitch stop(file);
  EXPECT_FALSE(stop.stopped());
  stop.stop({{"reason", "dinner"}});
  stop.keep(clock.now());
  EXPECT_TRUE(stop.stopped());
  EXPECT_THAT(stop.problem().at("what"), HasSubstr("the stop will not outlive a restart: "));
  EXPECT_THAT(stop.problem().at("what"), HasSubstr(file.string()));
  unblock();
  clock.advance(9s);
  stop.keep(clock.now());
  EXPECT_FALSE(is_there()) << "not tried in every round";
  clock.advance(1s);
  stop.keep(clock.now());
  EXPECT_TRUE(stop.problem().is_null());
  EXPECT_EQ(read_kept_stop(file).value(), "dinner");
}

TEST_F(KeptStop, IsWrittenAtOnceAfterAnotherThatCouldNotBe) {
  block();
  StopSwitch stop(file);
  stop.stop({{"reason", "dinner"}});
  stop.keep(clock.now());
  unblock();
  stop.stop({{"reason", "bed"}});
  stop.keep(clock.now());
  EXPECT_EQ(read_kept_stop(file).value(), "bed");
}

TEST_F(KeptStop, SaysIfAResumeCannotBeKept) {
  folder.write("state/stop-passive.json/in-the-way", "");
  StopSwitch stop(file);
  EXPECT_TRUE(stop.stopped()) << "a folder is no stop that can be read";
  stop.resume();
  stop.keep(clock.now());
  EXPECT_FALSE(stop.stopped());
  EXPECT_THAT(stop.problem().at("what"), HasSubstr("everything will be stopped again after a restart: "));
}

}  // namespace
}  // namespace telehug
