// SPDX-License-Identifier: Apache-2.0
//
// The daemons read their configuration anew on SIGHUP.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>

#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::Not;

class ARunningDaemon : public testing::TestWithParam<Side> {
 protected:
  void start() {
    write("");
    auto words = GetParam() == Side::active ? pair.active_command() : pair.passive_command();
    std::ranges::replace(words, std::string("/dev/null"), file().string());
    child = std::make_unique<ChildProcess>(words, log());
    ASSERT_TRUE(eventually([this] { return pair.status(GetParam()).is_object(); })) << content_of(log());
  }
  void write(const std::string& text) { pair.folder.write("side.toml", text); }
  [[nodiscard]] bool says_after_reload(const std::string& text) {
    ::kill(child->pid(), SIGHUP);
    return eventually([&] { return content_of(log()).find(text) != std::string::npos; });
  }
  [[nodiscard]] std::filesystem::path file() const { return pair.folder / "side.toml"; }
  [[nodiscard]] std::filesystem::path log() const { return pair.folder / "side.log"; }

  RunningPair pair;
  std::unique_ptr<ChildProcess> child;
};

TEST_P(ARunningDaemon, TakesWhatMayChangeNamesWhatNeedsARestartAndKeepsTheOldOneWhenTheNewIsFaulty) {
  start();
  write("[log]\nlevel = \"debug\"\n\n[web]\nport = 1\n");
  EXPECT_TRUE(says_after_reload("configuration: log.level is \"debug\" now, was \"info\"")) << content_of(log());
  EXPECT_THAT(content_of(log()), HasSubstr("configuration: web.port = 1 needs a restart; 0 is still in use"));
  write("[log]\nlevel = \"warn\"\n\n[web]\nport = \"x\"\n");
  EXPECT_TRUE(says_after_reload("configuration: not taken, the one before stays in use")) << content_of(log());
  EXPECT_THAT(content_of(log()), HasSubstr("configuration: " + file().string() + ":5: "));
  EXPECT_THAT(content_of(log()), Not(HasSubstr("\"warn\" now")));
  EXPECT_TRUE(child->runs());
  EXPECT_EQ(child->end(), 0);
}

INSTANTIATE_TEST_SUITE_P(BothSides, ARunningDaemon, testing::Values(Side::active, Side::passive),
                         [](const auto& side) { return side_name(side.param); });

TEST(AWearersDaemon, LoosensNoLimitWhileItRuns) {
  RunningPair pair;
  pair.folder.write("side.toml", "[safety]\nmax_strength = 0.3\n");
  auto words = pair.passive_command();
  std::ranges::replace(words, std::string("/dev/null"), (pair.folder / "side.toml").string());
  ChildProcess daemon(words, pair.folder / "side.log");
  ASSERT_TRUE(eventually([&] { return pair.status(Side::passive).is_object(); }));
  pair.folder.write("side.toml", "[safety]\nmax_strength = 1.0\n");
  ::kill(daemon.pid(), SIGHUP);
  EXPECT_TRUE(eventually([&] {
    return content_of(pair.folder / "side.log")
               .find("safety.max_strength = 1.0 needs a restart; 0.3 is still in use") != std::string::npos;
  })) << content_of(pair.folder / "side.log");
}

}  // namespace
}  // namespace telehug
