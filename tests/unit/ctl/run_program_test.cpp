// SPDX-License-Identifier: Apache-2.0
#include "ctl/run_program.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using ::testing::HasSubstr;

Result<ProgramRun> shell(const std::string& line, Duration longest = 20s) {
  return run_program({"sh", "-c", line}, longest, "no shell");
}

TEST(RunProgram, CollectsBothStreamsAndTheExitCode) {
  const auto run = shell("echo to the output; echo to the errors >&2; exit 3");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->code, 3);
  EXPECT_EQ(run->output, "to the output\nto the errors\n");
  EXPECT_FALSE(run->timed_out);
}

TEST(RunProgram, GivesItNoInputAndTheCLocale) {
  const auto run = shell("cat; echo $LC_ALL");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->output, "C\n");
}

TEST(RunProgram, KillsItWhenItTakesTooLong) {
  const auto run = shell("echo begun; exec sleep 600", 200ms);
  ASSERT_TRUE(run);
  EXPECT_TRUE(run->timed_out);
  EXPECT_EQ(run->code, -1);
}

TEST(RunProgram, LeavesOutWhatIsBeyondAMebibyteAndStillWaitsForTheEnd) {
  const auto run = shell("head -c 3000000 /dev/zero; exit 5");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->output.size(), 1U << 20U);
  EXPECT_EQ(run->code, 5);
}

TEST(RunProgram, TellsThatItIsMissingInTheWordsOfTheCaller) {
  const auto run = run_program({"no-such-program-of-telehug"}, 1s, "install it");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().message, "install it");
  EXPECT_THAT(run_program({"/"}, 1s, "install it").error().message, HasSubstr("can't run /"));
}

}  // namespace
}  // namespace telehug
