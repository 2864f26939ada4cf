// SPDX-License-Identifier: Apache-2.0
//
// What nft itself says of rules, judged.
#include "ctl/doctor/firewall.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <string>

#include "doubles/temporary_folder.hpp"
#include "integration/cli/shell.hpp"

namespace telehug {
namespace {

constexpr int port = 26650;

// Of these rules, loaded in a network of their own.
nlohmann::json loaded(const std::string& rules, const std::string& then = "true") {
  const TemporaryFolder folder;
  const std::string file = folder.write("rules.nft", rules);
  const std::string unshare = ::geteuid() == 0 ? "unshare -n" : "unshare -rn";
  const ShellRun run = shell(unshare + " sh -c 'nft -f " + file + " && " + then + " && nft -j list ruleset'");
  if (run.code != 0) throw std::runtime_error("nft refuses " + rules);
  return nlohmann::json::parse(run.text);
}

FirewallVerdict verdict_of(const std::string& rules) {
  return judge_firewall(loaded(rules), port);
}

// An input chain that drops what these rules do not decide.
std::string dropping(const std::string& rules, const std::string& beside = "") {
  return "table inet f {\n" + beside + "chain in { type filter hook input priority 0; policy drop;\n" + rules +
         "\n}\n}\n";
}

TEST(Firewall, WithoutRulesLetsIn) {
  EXPECT_EQ(verdict_of(""), FirewallVerdict::lets_in);
  EXPECT_EQ(judge_firewall(nlohmann::json(), port), FirewallVerdict::lets_some_in);
}

TEST(Firewall, ThatDropsKeepsOutWhateverItLetsInBeside) {
  EXPECT_EQ(verdict_of(dropping("ct state established,related accept\niif lo accept\ntcp dport 26650 accept\n"
                                "udp dport { 53, 1000-2000 } accept\nicmp type echo-request accept\n"
                                "ip6 saddr fe80::/10 accept")),
            FirewallVerdict::keeps_out);
}

TEST(Firewall, LetsInByPortRangeListAndSet) {
  for (const char* ports : {"26650", "26650-26679", "{ 53, 26650-26679 }", "!= 53"})
    EXPECT_EQ(verdict_of(dropping(std::string("udp dport ") + ports + " accept")), FirewallVerdict::lets_in) << ports;
  EXPECT_EQ(verdict_of(dropping("udp dport @ours accept",
                                "set ours { type inet_service; flags interval; elements = { 26650-26679 } }\n")),
            FirewallVerdict::lets_in);
  EXPECT_EQ(verdict_of(dropping("meta l4proto { tcp, udp } th dport 26650 accept")), FirewallVerdict::lets_in);
  EXPECT_EQ(verdict_of(dropping("udp dport @ours accept", "set ours { type inet_service; elements = { 53 } }\n")),
            FirewallVerdict::keeps_out);
}

TEST(Firewall, FollowsJumpsAndVerdictMaps) {
  const std::string beside = "chain ours { udp dport 26650-26679 accept; }\n";
  EXPECT_EQ(verdict_of(dropping("jump ours", beside)), FirewallVerdict::lets_in);
  EXPECT_EQ(verdict_of(dropping("ct state vmap { established : accept, invalid : drop, new : jump ours }", beside)),
            FirewallVerdict::lets_in);
  EXPECT_EQ(verdict_of(dropping("udp dport vmap { 53 : accept }")), FirewallVerdict::keeps_out);
  EXPECT_EQ(verdict_of(dropping("jump ours\nudp dport 26650 accept", "chain ours { return; }\n")),
            FirewallVerdict::lets_in);
}

TEST(Firewall, OfWhichSomeSendersPassLetsSomeIn) {
  EXPECT_EQ(verdict_of(dropping("ip saddr 192.0.2.7 udp dport 26650 accept")), FirewallVerdict::lets_some_in);
  EXPECT_EQ(verdict_of(dropping("iifname \"telehug-*\" accept")), FirewallVerdict::lets_some_in);
  EXPECT_EQ(verdict_of("table inet f { chain in { type filter hook input priority 0; policy accept;\n"
                       "udp dport 26650 ip saddr != 192.0.2.7 drop\n}\n}\n"),
            FirewallVerdict::lets_some_in);
  EXPECT_EQ(verdict_of("include \"" TELEHUG_SOURCE "/deploy/firewall/telehug.nft\"\n"), FirewallVerdict::lets_some_in);
}

TEST(Firewall, IsPassedOnlyIfEveryChainLetsIn) {
  const std::string lets_in =
      "table inet a { chain in { type filter hook input priority -10; policy drop;\n"
      "udp dport 26650 accept\n}\n}\n";
  EXPECT_EQ(verdict_of(lets_in), FirewallVerdict::lets_in);
  EXPECT_EQ(verdict_of(lets_in + dropping("")), FirewallVerdict::keeps_out);
  EXPECT_EQ(verdict_of(lets_in + "table ip6 b { chain in { type filter hook input priority 0; policy drop; }\n}\n"),
            FirewallVerdict::lets_in);
}

// In front of everything in that chain, whatever others accept.
TEST(Firewall, IsOpenedForTheSenderByTheCommandThatIsNamed) {
  const std::string open = "table inet a { chain in { type filter hook input priority -10; policy accept; }\n}\n";
  for (const std::string& rules :
       {open + dropping("tcp dport 22 accept"), open + dropping("jump others\n", "chain others { drop; }\n"),
        std::string(
            "table ip filter { chain INPUT { type filter hook input priority 0; policy accept; reject; }\n}\n")}) {
    const auto closing = closing_chain(loaded(rules), port);
    ASSERT_TRUE(closing) << rules;
    const std::string command = opening_command(*closing, "192.0.2.7", 26650, 26679);
    ASSERT_TRUE(command.starts_with("sudo nft insert rule ")) << command;
    EXPECT_EQ(judge_firewall(loaded(rules, command.substr(5)), port), FirewallVerdict::lets_some_in) << command;
  }
  EXPECT_FALSE(closing_chain(loaded(open), port));
}

TEST(Firewall, IsOpenedByTheToolThatMadeIt) {
  const auto opened_by = [](const std::string& rules) {
    const auto closing = closing_chain(loaded(rules), port);
    return closing ? opening_command(*closing, "PEER", 26650, 26679) : "";
  };
  EXPECT_EQ(opened_by("table ip filter { chain ufw-user-input { }\n chain INPUT { type filter hook input priority 0; "
                      "policy drop; jump ufw-user-input; }\n}\n"),
            "sudo ufw allow proto udp from PEER to any port 26650:26679");
  EXPECT_THAT(opened_by("table inet firewalld { chain filter_INPUT { type filter hook input priority 10; policy "
                        "accept; ct state invalid drop; reject; }\n}\n"),
              testing::StartsWith("sudo firewall-cmd --permanent --add-rich-rule='rule family=\"ipv4\" source "
                                  "address=\"PEER\" port port=\"26650-26679\" protocol=\"udp\" accept'"));
}

TEST(Firewall, RejectsAsItDrops) {
  EXPECT_EQ(verdict_of("table ip f { chain in { type filter hook input priority 0; policy accept;\n"
                       "tcp dport 22 accept\nreject\n}\n}\n"),
            FirewallVerdict::keeps_out);
}

}  // namespace
}  // namespace telehug
