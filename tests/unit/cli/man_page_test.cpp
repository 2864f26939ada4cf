// SPDX-License-Identifier: Apache-2.0
#include "cli/man_page.hpp"

#include <gmock/gmock.h>

#include "cli/roff.hpp"
#include "unit/cli/example_program.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Roff, EscapesWhatWouldBeReadAsAnOrder) {
  EXPECT_EQ(roff(".TH\n'x a\\b --c `d` ~e ^f"), "\\&.TH\n\\&\\(aqx a\\eb \\-\\-c \\(gad\\(ga \\(tie \\(haf");
}

TEST(Roff, KeepsAnArgumentWithQuotesInOnePiece) {
  EXPECT_EQ(roff_argument("a \"b\""), "\"a \\(dqb\\(dq\"");
}

TEST(ManPage, TellsEachCommandWithItsOptionsExamplesAndNotes) {
  const ExampleProgram tool;
  const std::string page = man_page(tool.program, tool.tree(), "2026-11-29");
  EXPECT_THAT(page, HasSubstr(".TH \"TOOL\" 1 \"2026-11-29\""));
  EXPECT_THAT(page, HasSubstr("tool \\- does it. All of it\n"));
  EXPECT_THAT(page, HasSubstr(".SS \"tool part list\""));
  EXPECT_THAT(page, HasSubstr("Run it \\- at once.\n"));
  EXPECT_THAT(page, HasSubstr("(left, right)"));
  EXPECT_THAT(page, HasSubstr("(1 to 9)"));
  EXPECT_THAT(page, HasSubstr("tool part list \\-\\-json"));
  EXPECT_THAT(page, HasSubstr("Parts are kept."));
  EXPECT_THAT(page, HasSubstr(".BR telehug (7)"));
}

TEST(ManPage, TellsTheExitCodesThatTheProgramHasAndNoOthers) {
  const ExampleProgram tool;
  const std::string page = man_page(tool.program, tool.tree(), "");
  EXPECT_THAT(page, HasSubstr(".TP\n.B \"2\"\nthe command line"));
  EXPECT_THAT(page, Not(HasSubstr(".TP\n.B \"3\"\n")));
}

}  // namespace
}  // namespace telehug
