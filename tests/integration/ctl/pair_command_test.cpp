// SPDX-License-Identifier: Apache-2.0
//
// Two PCs are paired by the commands that people type; what one prints is what the other reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "doubles/temporary_folder.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class PairCommand : public testing::Test {
 protected:
  // On one of the two PCs, whose state folder is a folder of its own. What it prints goes to `out` in the common
  // folder.
  int run(const std::string& pc, const std::string& arguments, const std::string& out) {
    const std::string line = "env -u STATE_DIRECTORY XDG_STATE_HOME=" + (folder / pc).string() +
                             " " TELEHUG_BIN "/telehug pair " + arguments + " >" + (folder / out).string() + " 2>" +
                             (folder / "errors").string();
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string content(const std::string& name) {
    std::ifstream in(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  Json listed(const std::string& pc) {
    EXPECT_EQ(run(pc, "list --json", "list"), 0);
    return Json::parse(content("list"));
  }

  void pair_up() {
    ASSERT_EQ(run("parent", "request --name Grandma", "request"), 0) << content("errors");
    ASSERT_EQ(run("wearer", "grant --name Mia --file " + (folder / "request").string(), "grant"), 0)
        << content("errors");
    ASSERT_EQ(run("parent", "finish <" + (folder / "grant").string(), "finish"), 0) << content("errors");
  }

  TemporaryFolder folder;
};

TEST_F(PairCommand, MakesAPairByTwoTexts) {
  pair_up();
  const Json parent = listed("parent").at(0);
  const Json wearer = listed("wearer").at(0);
  EXPECT_EQ(parent["phrase"], wearer["phrase"]);
  EXPECT_EQ(parent["id"], wearer["id"]);
  EXPECT_EQ(parent["name"], "Mia");
  EXPECT_EQ(wearer["name"], "Grandma");
  EXPECT_EQ(parent["side"], "active");
  EXPECT_EQ(wearer["side"], "passive");
  EXPECT_TRUE(parent["usable"] && wearer["usable"]);
  EXPECT_THAT(content("errors"), testing::IsEmpty());
}

TEST_F(PairCommand, RevokesOnThisPcAlone) {
  pair_up();
  const std::string id = listed("wearer").at(0)["id"];
  EXPECT_EQ(run("wearer", "revoke " + id, "out"), 0);
  EXPECT_TRUE(listed("wearer").empty());
  EXPECT_EQ(listed("parent").size(), 1U);
  EXPECT_EQ(run("wearer", "revoke " + id, "out"), to_int(ExitCode::refused));
}

TEST_F(PairCommand, SaysWhatIsWrongWithAText) {
  std::ofstream(folder / "request") << "Hello!";
  EXPECT_EQ(run("wearer", "grant --name Mia --file " + (folder / "request").string(), "out"),
            to_int(ExitCode::refused));
  EXPECT_THAT(content("errors"), HasSubstr("first line is missing"));
  EXPECT_EQ(run("wearer", "grant --name Mia --file /does/not/exist", "out"), to_int(ExitCode::usage));
  EXPECT_THAT(content("errors"), HasSubstr("/does/not/exist can't be read"));
  EXPECT_EQ(run("wearer", "finish </dev/null", "out"), to_int(ExitCode::refused));
}

TEST_F(PairCommand, SaysHowToBeginWhenThereIsNoPair) {
  EXPECT_EQ(run("parent", "list", "out"), 0);
  EXPECT_THAT(content("out"), HasSubstr("no pair yet"));
  EXPECT_TRUE(listed("parent").empty());
}

TEST_F(PairCommand, ListsWhatIsWrongWithAPairAndWhatMendsIt) {
  pair_up();
  const std::string id = listed("parent").at(0)["id"];
  std::filesystem::remove(folder / "parent" / "telehug" / "pairs" / "active" / id / "permissions.p7s");
  EXPECT_FALSE(listed("parent").at(0)["usable"]);
  EXPECT_EQ(run("parent", "list", "out"), 0);
  EXPECT_THAT(content("out"), HasSubstr("permissions.p7s: it is missing"));
}

}  // namespace
}  // namespace telehug
