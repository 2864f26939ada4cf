// SPDX-License-Identifier: Apache-2.0
#include "cli/command_tree.hpp"

#include <gmock/gmock.h>

#include "unit/cli/example_program.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Tree : public testing::Test {
 protected:
  [[nodiscard]] const CommandNode& at(const std::string& line) const { return *command_named(tree, line); }

  ExampleProgram tool;
  CommandNode tree = tool.tree();
};

const OptionNode& option(const CommandNode& command, const std::string& name) {
  for (const OptionNode& option : command.options)
    if (option.names.back() == name) return option;
  throw std::runtime_error("there is no option " + name);
}

TEST_F(Tree, HoldsEveryCommandWithItsWholePath) {
  std::vector<std::string> paths;
  for (const CommandNode* command : all_commands(tree))
    paths.push_back(command->path);
  EXPECT_THAT(paths, ElementsAre("tool", "tool run", "tool part", "tool part list", "tool part add"));
}

TEST_F(Tree, KnowsTheWordsThatAnOptionMayBe) {
  EXPECT_THAT(option(at("tool run"), "--side").choices, ElementsAre("left", "right"));
  EXPECT_THAT(option(at("tool run"), "--speed").choices, IsEmpty());
}

TEST_F(Tree, KnowsTheRangeOfANumber) {
  EXPECT_EQ(option(at("tool run"), "--speed").limits, "1 to 9");
}

TEST_F(Tree, TellsAFlagFromAnOptionThatTakesAValue) {
  EXPECT_EQ(option(at("tool part list"), "--json").value, "");
  EXPECT_NE(option(at("tool run"), "--speed").value, "");
}

TEST_F(Tree, KnowsAPositionalThatIsAFileAndMustBeThere) {
  const OptionNode& file = option(at("tool part add"), "file");
  EXPECT_TRUE(file.positional);
  EXPECT_TRUE(file.required);
  EXPECT_TRUE(file.takes_files());
}

TEST_F(Tree, AnExampleBelongsToTheCommandThatItsWordsName) {
  ASSERT_EQ(at("tool part list").examples.size(), 2U);
  EXPECT_EQ(at("tool part list").examples[1].line, "tool part list --json");
  EXPECT_EQ(at("tool run").examples.size(), 1U);
  EXPECT_THAT(at("tool part").examples, IsEmpty());
}

TEST_F(Tree, AnExampleOfAnotherProgramBelongsNowhere) {
  EXPECT_EQ(command_named(tree, "spool run"), nullptr);
  EXPECT_EQ(command_named(tree, ""), nullptr);
}

TEST_F(Tree, TheProgramShowsTheFirstExampleOfEachOfItsCommands) {
  std::vector<std::string_view> lines;
  for (const Example& example : headline_examples(tree, tool.program.examples))
    lines.push_back(example.line);
  EXPECT_THAT(lines, ElementsAre("tool run --side left", "tool part list | head"));
}

}  // namespace
}  // namespace telehug
