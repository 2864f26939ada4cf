// SPDX-License-Identifier: Apache-2.0
//
// The manual that is installed, against the programs that it is of.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "integration/cli/shell.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> programs{"telehug", "telehug-active", "telehug-passive", "telehug-jacket-sim"};

std::vector<fs::path> pages() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(TELEHUG_MANUAL)) {
    const std::string folder = entry.path().parent_path().filename().string();
    if (entry.is_regular_file() && folder.starts_with("man") && entry.path().extension() != ".gz")
      files.push_back(entry.path());
  }
  return files;
}

std::string rendered(const fs::path& page) {
  return shell("MANWIDTH=400 LC_ALL=C man -l '" + page.string() + "' 2>&1 | col -b").text;
}

std::string help(const std::string& command) {
  return shell(TELEHUG_BIN "/" + command + " --help").text;
}

// The commands that --help of each command names, and theirs.
void collect_commands(const std::string& path, std::vector<std::string>& all) {
  all.push_back(path);
  bool names = false;
  for (const std::string& line : lines_of(help(path))) {
    if (line == "Subcommands:") {
      names = true;
    } else if (line.empty()) {
      names = false;
    } else if (names && line.size() > 3 && line.starts_with("  ") && line[2] != ' ') {
      collect_commands(path + " " + line.substr(2, line.find(' ', 2) - 2), all);
    }
  }
}

std::vector<std::string> commands_of(const std::string& program) {
  std::vector<std::string> all;
  collect_commands(program, all);
  return all;
}

std::set<std::string> options_in(const std::string& text) {
  std::set<std::string> names;
  const std::regex option(R"((^|\n)  (-h,)?(--[a-z-]+))");
  for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match)
    names.insert((*match)[3]);
  names.erase("--help");
  return names;
}

TEST(Manual, HasEveryPageThatAPageRefersTo) {
  std::set<std::string> there;
  for (const fs::path& page : pages())
    there.insert(page.stem().string() + "(" + page.extension().string().substr(1) + ")");
  ASSERT_EQ(there.size(), 8U);
  const std::regex reference(R"(telehug[a-z.-]*\([0-9]\))");
  for (const fs::path& page : pages()) {
    const std::string text = rendered(page);
    std::sregex_iterator match(text.begin(), text.end(), reference);
    EXPECT_NE(match, std::sregex_iterator()) << page;
    for (; match != std::sregex_iterator(); ++match)
      EXPECT_EQ(there.count(match->str()), 1U) << page << match->str();
  }
}

TEST(Manual, IsWithoutFaultForManAndMandoc) {
  for (const fs::path& page : pages()) {
    EXPECT_THAT(shell("LC_ALL=C man -l --warnings '" + page.string() + "' 2>&1 >/dev/null").text, IsEmpty()) << page;
    EXPECT_THAT(shell("mandoc -T lint -W warning '" + page.string() + "'").text, IsEmpty()) << page;
  }
}

TEST(Manual, TellsEveryCommandAndOptionThatHelpTells) {
  for (const std::string& program : programs) {
    const std::string page = rendered(fs::path(TELEHUG_MANUAL "/man1") / (program + ".1"));
    for (const std::string& command : commands_of(program)) {
      const std::string title = command == program ? "\nOPTIONS\n" : "\n   " + command + "\n";
      const std::size_t begin = page.find(title);
      ASSERT_NE(begin, std::string::npos) << command;
      const std::string part = page.substr(begin, page.find("\n   telehug", begin + title.size()) - begin);
      for (const std::string& option : options_in(help(command)))
        EXPECT_THAT(part, HasSubstr(option)) << command;
    }
  }
}

TEST(Help, OfEveryCommandHasExamples) {
  for (const std::string& program : programs)
    for (const std::string& command : commands_of(program)) {
      const std::string text = help(command);
      // A command that only has others leaves them to these: one of its own names a command that is not there.
      if (command != program && text.find("\nSubcommands:\n") != std::string::npos) {
        EXPECT_THAT(text, testing::Not(HasSubstr("\nExamples:\n"))) << command;
        continue;
      }
      EXPECT_THAT(text, HasSubstr("\nExamples:\n  " + command)) << command;
    }
}

TEST(Help, ExamplesHaveOnlyOptionsThatTheCommandHas) {
  const std::regex option(R"( (--[a-z-]+))");
  for (const std::string& program : programs)
    for (const std::string& command : commands_of(program)) {
      if (command == program && program != "telehug-jacket-sim") continue;
      const std::string text = help(command);
      const std::size_t examples = text.find("\nExamples:\n");
      if (examples == std::string::npos) continue;
      const auto known = options_in(text.substr(0, examples));
      for (std::string line : lines_of(text.substr(examples))) {
        if (!line.starts_with("  " + command)) continue;
        line = line.substr(0, line.find("  ", 2));  // the meaning stands two blanks behind it
        for (std::sregex_iterator match(line.begin(), line.end(), option), end; match != end; ++match)
          EXPECT_EQ(known.count((*match)[1]), 1U) << line;
      }
    }
}

TEST(Manual, PagesWrittenByHandNameOnlyCommandsThatThereAre) {
  const std::regex command("\"?(telehug(-active|-passive)?( [a-z]+)+)\"?");
  for (const fs::path& page : pages()) {
    if (page.extension() == ".1") continue;
    std::ifstream file(page);
    int found = 0;
    for (std::string line; std::getline(file, line);) {
      if (!line.starts_with(".B ") && !line.starts_with(".RB ")) continue;
      line = std::regex_replace(line, std::regex(R"(\\-)"), "-");
      for (std::sregex_iterator match(line.begin(), line.end(), command), end; match != end; ++match) {
        ++found;
        EXPECT_EQ(shell(TELEHUG_BIN "/" + (*match)[1].str() + " --help >/dev/null").code, 0) << line;
      }
    }
    EXPECT_GT(found, 0) << page;
  }
}

TEST(Manual, TellsTheExitCodesThatHelpTells) {
  for (const std::string& program : programs) {
    const std::string page = rendered(fs::path(TELEHUG_MANUAL "/man1") / (program + ".1"));
    const std::string text = help(program);
    int codes = 0;
    for (const std::string& line : lines_of(text.substr(text.find("\nExit codes:\n") + 13))) {
      if (line.size() < 7) continue;
      ++codes;
      EXPECT_THAT(page, HasSubstr(line.substr(6)));
    }
    EXPECT_GE(codes, 3) << program;
  }
}

}  // namespace
}  // namespace telehug
