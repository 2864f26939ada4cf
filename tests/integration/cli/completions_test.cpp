// SPDX-License-Identifier: Apache-2.0
//
// The completions that are installed, asked through the shells themselves.
#include <gmock/gmock.h>

#include "doubles/temporary_folder.hpp"
#include "integration/cli/shell.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

// What bash offers when Tab is pressed behind `words`, the last of which may be unfinished.
std::vector<std::string> bash_offers(const std::string& words, const std::string& last) {
  const std::string program = words.substr(0, words.find(' '));
  std::string function = "_" + program;
  for (char& letter : function)
    if (letter == '-') letter = '_';
  const ShellRun run = shell("cd " TELEHUG_SOURCE "/deploy/man; bash -c '. " TELEHUG_MANUAL "/bash/" + program +
                             "; COMP_WORDS=(" + words + " \"" + last + "\"); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); " +
                             function + "; printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
  EXPECT_EQ(run.code, 0);
  auto offers = lines_of(run.text);
  if (offers == std::vector<std::string>{""}) offers.clear();
  return offers;
}

TEST(BashCompletion, FinishesACommand) {
  EXPECT_THAT(bash_offers("telehug", "jac"), ElementsAre("jacket"));
  EXPECT_THAT(bash_offers("telehug", "st"), AllOf(Contains("status"), Contains("stop"), Contains("strength")));
}

TEST(BashCompletion, OffersTheCommandsBelowACommand) {
  EXPECT_THAT(bash_offers("telehug pair", ""), AllOf(Contains("invite"), Contains("accept"), Not(Contains("status"))));
}

TEST(BashCompletion, OffersTheOptionsOfTheCommand) {
  EXPECT_THAT(bash_offers("telehug pair invite", "--qr"), ElementsAre("--qr", "--qr-svg"));
}

TEST(BashCompletion, OffersTheWordsThatAnOptionMayBe) {
  EXPECT_THAT(bash_offers("telehug status --json --side", ""), ElementsAre("active", "passive"));
}

TEST(BashCompletion, OffersFilesWhereAFileIsMeant) {
  EXPECT_THAT(bash_offers("telehug-passive run --config", "tele"),
              AllOf(Contains("telehug.7.in"), Contains("telehug-daemons.8.in")));
}

TEST(BashCompletion, OffersNothingWhereAnythingMayStand) {
  EXPECT_THAT(bash_offers("telehug stop --reason", ""), IsEmpty());
}

TEST(BashCompletion, TakesTheValueOfAnOptionForNoCommand) {
  EXPECT_THAT(bash_offers("telehug --version pair list --folder status", "--j"), ElementsAre("--json"));
}

TEST(BashCompletion, KnowsEveryProgram) {
  EXPECT_THAT(bash_offers("telehug-active", "cal"), ElementsAre("calibrate"));
  EXPECT_THAT(bash_offers("telehug-passive", "ch"), ElementsAre("check-jacket"));
  EXPECT_THAT(bash_offers("telehug-jacket-sim --board", "motors16"), ElementsAre("motors16"));
}

// Runs `line` with a home of its own: the shells write their settings there.
ShellRun shell_with_new_home(const std::string& line) {
  const TemporaryFolder home;
  return shell("HOME='" + home.path().string() + "' " + line);
}

// "WORD\tDESCRIPTION" a line.
std::vector<std::string> fish_offers(const std::string& line) {
  const ShellRun run = shell_with_new_home("fish --no-config -c 'for file in " TELEHUG_MANUAL
                                           "/fish/*.fish; source $file; end; complete -C \"" +
                                           line + "\"' 2>/dev/null");
  EXPECT_EQ(run.code, 0);
  return lines_of(run.text);
}

TEST(FishCompletion, FinishesCommandsOptionsAndTheirWords) {
  EXPECT_THAT(fish_offers("telehug jac"),
              ElementsAre("jacket\tThe jacket on this PC: what it has, and whether that works"));
  EXPECT_THAT(fish_offers("telehug pair inv"), ElementsAre("invite\tPrint a code and wait for the other PC"));
  EXPECT_THAT(fish_offers("telehug pair invite --qr-"), ElementsAre(testing::StartsWith("--qr-svg\t")));
  EXPECT_THAT(fish_offers("telehug status --side a"), Contains(testing::StartsWith("active")));
}

TEST(FishCompletion, OffersNoFilesWhereACommandIsMeant) {
  EXPECT_THAT(fish_offers("telehug pair "), Not(Contains(testing::HasSubstr("/"))));
}

bool zsh_offers(const std::string& line, const std::string& word) {
  return shell_with_new_home("timeout 30 zsh -f " TELEHUG_SOURCE "/tests/integration/cli/zsh_offers.zsh " TELEHUG_MANUAL
                             "/zsh '" +
                             line + "' '" + word + "' 2>/dev/null")
             .code == 0;
}

TEST(ZshCompletion, OffersCommandsTheirCommandsAndTheirOptions) {
  EXPECT_TRUE(zsh_offers("telehug ", "unmute"));
  EXPECT_TRUE(zsh_offers("telehug jacket ", "identify"));
  EXPECT_TRUE(zsh_offers("telehug pair invite --qr", "qr-svg"));
}

TEST(ZshCompletion, OffersTheWordsThatAnOptionMayBe) {
  EXPECT_TRUE(zsh_offers("telehug-jacket-sim --board ", "motors12_heaters2"));
}

}  // namespace
}  // namespace telehug
