// SPDX-License-Identifier: Apache-2.0
#include "pairing/wireguard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>

#include "doubles/temporary_folder.hpp"
#include "pairing/armour.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::Not;

const WallTime now{std::chrono::seconds(1'800'000'000)};

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What stands behind "KEY = " in wg-quick's file; empty if the key is absent.
std::string value(const std::string& conf, const std::string& key) {
  const std::string begin = "\n" + key + " = ";
  const std::size_t at = conf.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return conf.substr(from, conf.find('\n', from) - from);
}

TEST(TunnelEndpoints, GetWireGuardsUsualPort) {
  EXPECT_EQ(*parse_tunnel_endpoint("home.example.org"), "home.example.org:51820");
  EXPECT_EQ(*parse_tunnel_endpoint("198.51.100.7"), "198.51.100.7:51820");
  EXPECT_EQ(*parse_tunnel_endpoint("2001:db8::7"), "[2001:db8::7]:51820");
  EXPECT_EQ(*parse_tunnel_endpoint("[2001:db8::7]"), "[2001:db8::7]:51820");
}

TEST(TunnelEndpoints, KeepTheirOwnPort) {
  for (const char* good : {"home.example.org:4711", "198.51.100.7:1", "[2001:db8::7]:65535"})
    EXPECT_EQ(*parse_tunnel_endpoint(good), good);
}

// They come to stand in a file that root's wg-quick runs commands from.
TEST(TunnelEndpoints, AreNothingElse) {
  for (const char* wrong :
       {"", ":51820", "home:0", "home:65536", "home:", "home:51820:1", "home:51820\nPostUp = reboot",
        "home\nPostUp = reboot", "home org", "-home", ".", "[::1", "::1]:5", "[home]:5", "[::1]x", "[]:5", "höme"})
    EXPECT_FALSE(parse_tunnel_endpoint(wrong)) << wrong;
  EXPECT_FALSE(parse_tunnel_endpoint(std::string(254, 'a')));
}

class Tunnels : public testing::Test {
 protected:
  struct Ends {
    Pair parent;
    Pair wearer;
  };
  Ends pair_up(const std::string& parent_at, const std::string& wearer_at) {
    const auto granted = wearer.grant(parent.request("Grandma", parent_at).value(), "Mia", now, wearer_at).value();
    return {parent.accept(granted.grant, now).value(), granted.pair};
  }
  static std::string conf(const Pair& pair) { return content(tunnel_of(pair)->file); }
  // The text with something else in its part about WireGuard.
  static std::string changed(const std::string& kind, const std::string& text, const nlohmann::json& offer) {
    nlohmann::json json = unarmour(kind, text).value();
    json["wireguard"] = offer;
    return armour(kind, json);
  }

  TemporaryFolder folder;
  PairStore parent{folder / "parent", Side::active};
  PairStore wearer{folder / "wearer", Side::passive};
};

TEST_F(Tunnels, AreMadeIfOneSideCanBeDialledWhicheverItIs) {
  for (const auto& [parent_at, wearer_at] :
       {std::pair("home:4711", ""), std::pair("", "home:4711"), std::pair("home:4711", "there:4712")}) {
    const auto [here, there] = pair_up(parent_at, wearer_at);
    ASSERT_TRUE(tunnel_of(here) && tunnel_of(there));
    const std::string parents = conf(here);
    const std::string wearers = conf(there);
    EXPECT_EQ(value(parents, "Address"), value(wearers, "AllowedIPs"));
    EXPECT_EQ(value(wearers, "Address"), value(parents, "AllowedIPs"));
    EXPECT_NE(value(parents, "Address"), value(wearers, "Address"));
    EXPECT_EQ(value(parents, "Endpoint"), wearer_at);
    EXPECT_EQ(value(wearers, "Endpoint"), parent_at);
    EXPECT_EQ(value(parents, "ListenPort"), *parent_at == 0 ? "" : "4711");
    EXPECT_EQ(value(parents, "PersistentKeepalive"), *wearer_at == 0 ? "" : "25");
    EXPECT_EQ(tunnel_of(here)->listen_port, value(parents, "ListenPort"));
    EXPECT_EQ(tunnel_of(here)->peer_address, tunnel_of(there)->own_address);
    EXPECT_EQ(tunnel_of(here)->interface, tunnel_of(there)->interface);
    EXPECT_LE(tunnel_of(here)->interface.size(), 15U);
    EXPECT_EQ(here.phrase, there.phrase);
  }
}

TEST_F(Tunnels, ListenAtTheUsualPortIfNoneIsSaid) {
  const auto [here, there] = pair_up("", "2001:db8::7");
  EXPECT_EQ(value(conf(there), "ListenPort"), "51820");
  EXPECT_EQ(value(conf(here), "Endpoint"), "[2001:db8::7]:51820");
  EXPECT_FALSE(parent.request("Grandma", "home:1\nPostUp = reboot"));
}

TEST_F(Tunnels, AreNotMadeIfNobodyAsks) {
  const auto [here, there] = pair_up("", "");
  EXPECT_FALSE(tunnel_of(here));
  EXPECT_FALSE(tunnel_of(there));
}

TEST_F(Tunnels, HaveAddressesOfTheirOwn) {
  const auto first = pair_up("", "home:1").wearer;
  const auto second = pair_up("", "home:1").wearer;
  EXPECT_NE(tunnel_of(first)->own_address, tunnel_of(second)->own_address);
  EXPECT_NE(tunnel_of(first)->interface, tunnel_of(second)->interface);
  EXPECT_THAT(tunnel_of(first)->own_address, testing::MatchesRegex("10\\.[0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST_F(Tunnels, NeverSendTheirSecretKeys) {
  const std::string request = parent.request("Grandma", "home:1").value();
  const auto granted = wearer.grant(request, "Mia", now).value();
  const Pair here = parent.accept(granted.grant, now).value();
  const std::string texts =
      unarmour("request", request).value().dump() + unarmour("grant", granted.grant).value().dump();
  for (const Pair& pair : {here, granted.pair}) {
    const std::string secret = value(conf(pair), "PrivateKey");
    ASSERT_EQ(secret.size(), 44U);
    EXPECT_THAT(texts, Not(HasSubstr(secret)));
  }
  EXPECT_THAT(texts, HasSubstr(value(conf(here), "PublicKey")));
  EXPECT_THAT(texts, HasSubstr(value(conf(granted.pair), "PublicKey")));
}

TEST_F(Tunnels, AreTheirOwnersAloneAndGoWithThePair) {
  const auto [here, there] = pair_up("home:1", "");
  const auto file = tunnel_of(there)->file;
  struct stat about {};
  ASSERT_EQ(stat(file.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0600U);
  EXPECT_FALSE(std::filesystem::exists(folder / "parent" / "pending.wireguard"));
  EXPECT_TRUE(wearer.revoke(there.id));
  EXPECT_FALSE(std::filesystem::exists(file));
}

// Somebody on the way who puts a key of their own in would be let into the tunnel: the phrase tells.
TEST_F(Tunnels, OfWhichAKeyWasExchangedOnTheWayHaveDifferentPhrases) {
  const TunnelEnd stranger = make_tunnel_end("home:1");
  const auto granted =
      wearer.grant(changed("request", parent.request("Grandma", "home:1").value(), to_json(stranger.offer)), "Mia", now)
          .value();
  EXPECT_NE(parent.accept(granted.grant, now)->phrase, granted.pair.phrase);

  const auto second = wearer.grant(parent.request("Grandma", "home:1").value(), "Mia", now).value();
  EXPECT_NE(parent.accept(changed("grant", second.grant, to_json(stranger.offer)), now)->phrase, second.pair.phrase);
}

TEST_F(Tunnels, AreNotMadeFromTextsThatAreDamaged) {
  const std::string request = parent.request("Grandma", "home:1").value();
  const std::string key = make_tunnel_end("").offer.public_key;
  for (const nlohmann::json& wrong :
       {nlohmann::json(7), nlohmann::json::object(), nlohmann::json{{"public_key", key + "\n"}},
        nlohmann::json{{"public_key", key.substr(1)}}, nlohmann::json{{"public_key", std::string(44, '=')}},
        nlohmann::json{{"public_key", "!" + key.substr(1)}},
        nlohmann::json{{"public_key", key}, {"endpoint", "home:1\nPostUp = reboot"}}}) {
    EXPECT_THAT(wearer.grant(changed("request", request, wrong), "Mia", now).error().message,
                HasSubstr("WireGuard is damaged"))
        << wrong;
  }
  EXPECT_TRUE(wearer.list().empty());
}

TEST_F(Tunnels, AreAskedForInVainOfAnOlderTelehug) {
  nlohmann::json older = unarmour("request", parent.request("Grandma").value()).value();
  older.erase("wireguard");
  const std::string request = armour("request", older);
  EXPECT_THAT(wearer.grant(request, "Mia", now, "home:1").error().message, HasSubstr("telehug is older"));
  EXPECT_TRUE(wearer.grant(request, "Mia", now));
}

}  // namespace
}  // namespace telehug
