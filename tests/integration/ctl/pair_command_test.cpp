// SPDX-License-Identifier: Apache-2.0
//
// `telehug pair` as two PCs use it: two stores, real programs, loopback.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "doubles/child_program.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

class PairCommand : public testing::Test {
 protected:
  [[nodiscard]] std::string on(const std::string& side) const {
    return " --side " + side + " --folder " + (folder_ / side).string();
  }

  int run(const std::string& arguments, const std::string& in = "/dev/null", const std::string& out = "out.txt") const {
    const std::string line = std::string(TELEHUG_BIN "/telehug pair ") + arguments + " <" + in + " >" +
                             (folder_ / out).string() + " 2>" + (folder_ / "errors.txt").string();
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }
  Json pairs(const std::string& side) const {
    EXPECT_EQ(run("list --json" + on(side)), 0);
    return Json::parse(content("out.txt"))["pairs"];
  }
  void expect_one_pair_on_both() const {
    const Json parents = pairs("active");
    const Json wearers = pairs("passive");
    ASSERT_EQ(parents.size(), 1U);
    ASSERT_EQ(wearers.size(), 1U);
    EXPECT_EQ(parents[0]["id"], wearers[0]["id"]);
    EXPECT_EQ(parents[0]["phrase"], wearers[0]["phrase"]);
    EXPECT_EQ(parents[0]["name"], "Kim");
    EXPECT_EQ(wearers[0]["name"], "Mum");
  }
  void pair_up_by_texts() const {
    ASSERT_EQ(run("request --name Mum" + on("active"), "/dev/null", "request.txt"), 0) << content("errors.txt");
    ASSERT_EQ(run("grant --name Kim" + on("passive"), folder_ / "request.txt", "grant.txt"), 0)
        << content("errors.txt");
    ASSERT_EQ(run("finish" + on("active"), folder_ / "grant.txt"), 0) << content("errors.txt");
  }
  void expect_refused(const std::string& arguments, const std::string& why) const {
    EXPECT_EQ(run(arguments), 9);
    EXPECT_NE(content("errors.txt").find(why), std::string::npos) << content("errors.txt");
  }
  [[nodiscard]] ChildProgram invite() const {
    return ChildProgram({TELEHUG_BIN "/telehug", "pair", "invite", "--json", "--side", "passive", "--folder",
                         (folder_ / "passive").string(), "--address", "127.0.0.1", "--name", "Kim"});
  }

  TemporaryFolder folder_;
};

TEST_F(PairCommand, InvitesAcceptsListsAndRevokes) {
  const ChildProgram inviter = invite();
  const std::string code = Json::parse(inviter.read_line())["code"];
  ASSERT_EQ(run("accept " + code + " --name Mum --json" + on("active")), 0) << content("errors.txt");
  const Json accepted = Json::parse(content("out.txt"));
  EXPECT_EQ(Json::parse(inviter.read_line())["pair"]["phrase"], accepted["pair"]["phrase"]);
  expect_one_pair_on_both();

  const std::string id = accepted["pair"]["id"];
  for (const std::string side : {"active", "passive"}) {
    EXPECT_EQ(run("revoke " + id + on(side)), 0);
    EXPECT_TRUE(pairs(side).empty());
    EXPECT_EQ(run("revoke " + id + on(side)), 9);
  }
}

TEST_F(PairCommand, PairsWithoutAConnection) {
  pair_up_by_texts();
  expect_one_pair_on_both();
}

TEST_F(PairCommand, InvitesByAQrCodeWhoseTextItAccepts) {
  const auto svg = folder_ / "code.svg";
  const ChildProgram inviter({TELEHUG_BIN "/telehug", "pair", "invite", "--qr", "--qr-svg", svg.string(), "--side",
                              "passive", "--folder", (folder_ / "passive").string(), "--address", "127.0.0.1"});
  int lines = 0;
  std::string line = inviter.read_line();
  for (; line.starts_with('\x1b'); line = inviter.read_line())
    ++lines;
  EXPECT_EQ(lines, 19);
  EXPECT_NE(content("code.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(std::filesystem::status(svg).permissions(), std::filesystem::perms(0600));
  EXPECT_EQ(run("accept telehug:pair:" + line + on("active")), 0) << content("errors.txt");
}

TEST_F(PairCommand, RenewsAPairByHand) {
  pair_up_by_texts();
  const std::string id = pairs("active").at(0).at("id");
  // What was paired within this very second ends no later when it is renewed.
  const std::string expires = pairs("active").at(0).at("expires");
  ASSERT_EQ(run("renew Mum --json" + on("passive"), "/dev/null", "renewal.txt"), 0) << content("errors.txt");
  EXPECT_EQ(Json::parse(content("errors.txt"))["pair"]["id"], id);
  ASSERT_EQ(run("finish --json" + on("active"), folder_ / "renewal.txt"), 0) << content("errors.txt");
  const Json finished = Json::parse(content("out.txt"));
  EXPECT_EQ(finished["pair"]["id"], id);
  EXPECT_EQ(finished["renewed"], pairs("passive").at(0).at("expires") != expires);
  // A second time there is nothing to do.
  ASSERT_EQ(run("finish" + on("active"), folder_ / "renewal.txt"), 0) << content("errors.txt");
  EXPECT_NE(content("out.txt").find("(id " + id + ") is valid already until 20"), std::string::npos)
      << content("out.txt");
  ASSERT_EQ(run("renew " + id + " --file " + (folder_ / "by-file.txt").string() + on("passive")), 0);
  EXPECT_EQ(run("finish --file " + (folder_ / "by-file.txt").string() + on("active")), 0) << content("errors.txt");
  for (const std::string side : {"active", "passive"})
    EXPECT_TRUE(pairs(side).at(0).at("faults").empty());
}

TEST_F(PairCommand, SaysWhyAPairCantBeRenewed) {
  pair_up_by_texts();
  const std::string id = pairs("passive").at(0).at("id");
  expect_refused("renew Kim" + on("active"), "is renewed on the wearer's");
  expect_refused("renew Dad" + on("passive"), "no pair Dad");
  std::filesystem::remove(folder_ / "passive" / id / "identity_ca.key");
  expect_refused("renew Mum" + on("passive"), "pair the two PCs again");
  ASSERT_EQ(run("grant --name Kim" + on("passive"), folder_ / "request.txt"), 0) << content("errors.txt");
  expect_refused("renew Mum" + on("passive"), "say which by its id: ");
}

TEST_F(PairCommand, MakesATunnelsFilesAndSaysWhatToRun) {
  ASSERT_EQ(run("request --name Mum" + on("active"), "/dev/null", "request.txt"), 0) << content("errors.txt");
  ASSERT_EQ(run("grant --wireguard home.example.org" + on("passive"), folder_ / "request.txt", "grant.txt"), 0)
      << content("errors.txt");
  EXPECT_NE(content("errors.txt").find("The other PC dials this one"), std::string::npos) << content("errors.txt");
  ASSERT_EQ(run("finish" + on("active"), folder_ / "grant.txt"), 0) << content("errors.txt");
  const Json pair = pairs("active").at(0);
  const std::string interface = pair.at("tunnel").at("interface");
  EXPECT_EQ(pair["tunnel"]["peer_address"], pairs("passive").at(0)["tunnel"]["address"]);
  EXPECT_TRUE(std::filesystem::exists(pair["tunnel"]["file"].get<std::string>()));
  EXPECT_EQ(run("list" + on("active")), 0);
  EXPECT_NE(content("out.txt").find("tunnel " + interface), std::string::npos) << content("out.txt");
  const std::string id = pair["id"];
  ASSERT_EQ(run("revoke " + id + on("active")), 0);
  EXPECT_NE(content("out.txt").find("systemctl disable --now wg-quick@" + interface), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(pair["tunnel"]["file"].get<std::string>()));
}

TEST_F(PairCommand, MakesATunnelOverAConnectionThatEitherPcAsksFor) {
  const ChildProgram inviter = invite();
  const std::string code = Json::parse(inviter.read_line())["code"];
  ASSERT_EQ(run("accept " + code + " --wireguard 198.51.100.7:4711 --json" + on("active")), 0) << content("errors.txt");
  const Json parents = Json::parse(content("out.txt"))["pair"];
  const Json wearers = Json::parse(inviter.read_line())["pair"];
  EXPECT_EQ(parents["tunnel"]["address"], wearers["tunnel"]["peer_address"]);
  EXPECT_EQ(parents["phrase"], wearers["phrase"]);
}

TEST_F(PairCommand, SaysThatNobodyCanDialThere) {
  EXPECT_EQ(run("request --wireguard 'home org'" + on("active")), 2);
  EXPECT_NE(content("errors.txt").find("not where a PC can be dialled"), std::string::npos) << content("errors.txt");
}

TEST_F(PairCommand, KeepsNothingWhenBothPcsAreAWearers) {
  const ChildProgram inviter = invite();
  const std::string code = Json::parse(inviter.read_line())["code"];
  EXPECT_EQ(run("accept " + code + " --side passive --folder " + (folder_ / "other").string()), 9);
  EXPECT_NE(content("errors.txt").find("both PCs are a wearer's"), std::string::npos) << content("errors.txt");
  EXPECT_EQ(inviter.read_line(), "");
  EXPECT_TRUE(pairs("passive").empty());
}

TEST_F(PairCommand, ListsWhatIsWrongWithAPairAndWhatMendsIt) {
  pair_up_by_texts();
  EXPECT_TRUE(pairs("passive").at(0).at("faults").empty());
  const std::string id = pairs("passive").at(0).at("id");
  std::filesystem::remove(folder_ / "passive" / id / "permissions.p7s");
  EXPECT_EQ(pairs("passive").at(0).at("faults").size(), 1U);
  EXPECT_EQ(run("list" + on("passive")), 0);
  EXPECT_NE(content("out.txt").find("permissions.p7s: it is missing"), std::string::npos) << content("out.txt");
}

// As on a PC whose pairs are the service's, by `sudo telehug pair`.
TEST_F(PairCommand, GivesWhatRootMakesToTheOwnerOfTheFolderAndWhatRootNamedToRoot) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may act as somebody else";
  constexpr uid_t service = 4242;
  const auto owner = [](const std::filesystem::path& path) {
    struct stat facts {};
    return lstat(path.c_str(), &facts) == 0 ? facts.st_uid : uid_t{9999};
  };
  std::filesystem::permissions(folder_.path(), std::filesystem::perms(0711));
  std::filesystem::create_directory(folder_ / "state");
  ASSERT_EQ(chown((folder_ / "state").c_str(), service, service), 0);
  std::filesystem::permissions(folder_ / "state", std::filesystem::perms(0700));
  std::filesystem::create_directory(folder_ / "roots");
  std::filesystem::permissions(folder_ / "roots", std::filesystem::perms(0700));
  const std::string parents = " --side active --folder " + (folder_ / "parents").string();
  const std::string wearers = " --side passive --folder " + (folder_ / "state/pairs/passive").string();

  ASSERT_EQ(run("request --name Mum" + parents, "/dev/null", "roots/request.txt"), 0) << content("errors.txt");
  ASSERT_EQ(run("grant --name Kim --file " + (folder_ / "roots/request.txt").string() + wearers, "/dev/null",
                "roots/grant.txt"),
            0)
      << content("errors.txt");
  ASSERT_EQ(run("renew Mum --file " + (folder_ / "roots/renewal.txt").string() + wearers), 0) << content("errors.txt");

  std::size_t entries = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "state")) {
    EXPECT_EQ(owner(entry.path()), service) << entry.path();
    ++entries;
  }
  EXPECT_GT(entries, 5U);
  EXPECT_EQ(owner(folder_ / "roots/renewal.txt"), 0U);
}

// The account of a service that was taken over must not lead root to what is not its own.
TEST_F(PairCommand, FollowsNoLinkOutOfTheOwnersFoldersAsRoot) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may act as somebody else";
  std::filesystem::permissions(folder_.path(), std::filesystem::perms(0711));
  std::filesystem::create_directory(folder_ / "state");
  std::filesystem::create_directory(folder_ / "roots");
  std::filesystem::create_directory_symlink(folder_ / "roots", folder_ / "state/pairs");
  ASSERT_EQ(chown((folder_ / "state").c_str(), 4242, 4242), 0);
  EXPECT_NE(run("request --name Mum --side active --folder " + (folder_ / "state/pairs").string()), 0);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "roots"));
}

TEST_F(PairCommand, DoesNotCallItSuccessWhenTheTextCouldNotBeWritten) {
  const std::string line = TELEHUG_BIN "/telehug pair request --name Mum" + on("active") + " >/dev/full 2>" +
                           (folder_ / "errors.txt").string();
  EXPECT_NE(std::system(line.c_str()), 0);
  EXPECT_NE(content("errors.txt").find("is the disk full?"), std::string::npos) << content("errors.txt");
}

TEST_F(PairCommand, SaysThatACodeIsMistyped) {
  EXPECT_EQ(run("accept 12345" + on("active")), 2);
  EXPECT_NE(content("errors.txt").find("pairing code has 40"), std::string::npos) << content("errors.txt");
}

TEST_F(PairCommand, KeepsThePairsWhereTheConfigurationOfTheDaemonSays) {
  const auto place = folder_ / "as-configured";
  folder_.write("config/telehug/passive.toml", "[peer]\npairs_folder = \"" + place.string() + "\"\n");
  setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
  ASSERT_EQ(run("request --name Mum" + on("active"), "/dev/null", "request.txt"), 0) << content("errors.txt");
  EXPECT_EQ(run("grant --name Kim", folder_ / "request.txt", "grant.txt"), 0) << content("errors.txt");
  unsetenv("XDG_CONFIG_HOME");
  EXPECT_EQ(run("list --json --side passive --folder " + place.string()), 0);
  EXPECT_EQ(Json::parse(content("out.txt"))["pairs"].size(), 1U);
}

}  // namespace
}  // namespace telehug
