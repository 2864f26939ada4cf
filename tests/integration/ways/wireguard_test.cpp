// SPDX-License-Identifier: Apache-2.0
//
// Two homes whose routers hide the PCs, with one forwarded UDP port, and nothing but WireGuard between them: with the
// files that the pairing wrote, begun by wg-quick as a person does.
#include <arpa/inet.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>
#include <vector>

#include "integration/link_faults/faulty_link.hpp"
#include "netlab/run_inside.hpp"
#include "netlab/wireguard_tunnel.hpp"
#include "pairing/wireguard.hpp"

namespace telehug {
namespace {

constexpr std::uint16_t port = 51820;
// As in test_link_faults: twice what is asked for must do on a busy PC.
constexpr double longest_off_ms = 600;
constexpr double longest_back_s = 6;

// Sends what it gets back to where it came from, until it is told to stop.
class Echo {
 public:
  explicit Echo(const NetNamespace& network) {
    const InsideNamespace inside(network);
    socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in any{};
    any.sin_family = AF_INET;
    sockaddr_storage bound{};
    socklen_t size = sizeof bound;
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&bound), &size), 0);
    port_ = ntohs(reinterpret_cast<const sockaddr_in*>(&bound)->sin_port);
    const timeval wait{0, 50'000};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
    answers_ = std::jthread([this](const std::stop_token& stop) { answer(stop); });
  }
  ~Echo() {
    answers_ = {};
    close(socket_);
  }
  Echo(const Echo&) = delete;
  Echo& operator=(const Echo&) = delete;

  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }

 private:
  void answer(const std::stop_token& stop) const {
    std::array<char, 2048> bytes{};
    while (!stop.stop_requested()) {
      sockaddr_storage from{};
      socklen_t size = sizeof from;
      const ssize_t got = recvfrom(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
      if (got > 0)
        (void)!sendto(socket_, bytes.data(), static_cast<std::size_t>(got), 0, reinterpret_cast<sockaddr*>(&from),
                      size);
    }
  }

  int socket_ = -1;
  std::uint16_t port_ = 0;
  std::jthread answers_;
};

// The median of the round trips of datagrams as large as a touch event; nothing if none comes back.
std::optional<double> round_trip_us(const NetNamespace& from, const std::string& address, std::uint16_t to_port) {
  const InsideNamespace inside(from);
  const int datagrams = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (datagrams < 0) return std::nullopt;
  const timeval wait{0, 200'000};
  setsockopt(datagrams, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(to_port);
  inet_pton(AF_INET, address.c_str(), &to.sin_addr);
  std::vector<double> took_us;
  std::array<char, 400> bytes{};
  for (int i = 0; i < 1000; ++i) {
    std::memcpy(bytes.data(), &i, sizeof i);
    const Timestamp sent = SteadyClock{}.now();
    (void)!sendto(datagrams, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    int answered = -1;  // what comes late is no answer to this one
    while (answered != i && recv(datagrams, bytes.data(), bytes.size(), 0) > 0)
      std::memcpy(&answered, bytes.data(), sizeof answered);
    if (answered == i) took_us.push_back(to_ms(SteadyClock{}.now() - sent) * 1000);
    if (i > 10 && took_us.empty()) break;
  }
  close(datagrams);
  if (took_us.empty()) return std::nullopt;
  const auto middle = took_us.begin() + static_cast<std::ptrdiff_t>(took_us.size() / 2);
  std::nth_element(took_us.begin(), middle, took_us.end());
  return *middle;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// wg-quick's file with another value of that key, in its last section if it was absent; without it if that is empty.
std::string with(std::string conf, const std::string& key, const std::string& value) {
  const std::string begin = "\n" + key + " = ";
  const std::size_t at = conf.find(begin);
  if (at != std::string::npos) conf.erase(at + 1, conf.find('\n', at + 1) - at);
  if (value.empty()) return conf;
  const std::string line = key + " = " + value + "\n";
  return at != std::string::npos ? conf.insert(at + 1, line) : conf + line;
}

class Wireguard : public testing::Test {
 protected:
  void SetUp() override {
    if (!tunnels_are_permitted()) GTEST_SKIP() << "tunnels need root and /dev/net/tun, which are missing here";
    try {
      link = std::make_unique<FaultyLink>(FaultyLink::Pairing::done, wearer_at);
    } catch (const std::system_error& error) {
      GTEST_SKIP() << "network namespaces are not permitted here: " << error.what();
    }
    link->homes.let_only_pass(port);
    connect();
  }
  // The PCs with the homes' networks.
  virtual void connect() {
    link->hide(Home::parent);
    link->hide(Home::child).forward(port, port);
  }
  void TearDown() override {
    // The daemons first, which would try to live without it.
    if (link) link->pair.active.reset();
    if (link) link->pair.passive.reset();
    ends.clear();
  }

  [[nodiscard]] Pair pair_of(Side side) const { return link->pair.pairs(side).list().at(0); }
  [[nodiscard]] PairTunnel tunnel(Side side) const { return tunnel_of(pair_of(side)).value(); }
  static Home home(Side side) { return side == Side::active ? Home::parent : Home::child; }

  // Where a tunnel's file is installed.
  [[nodiscard]] std::filesystem::path installed(Side side) const {
    const auto folder = link->pair.folder / (side == Side::active ? "parents-etc" : "wearers-etc");
    std::filesystem::create_directory(folder);
    return folder / (tunnel(side).interface + ".conf");
  }
  // What the pairing tells the person to run, but for where it is put.
  void begin(Side side) {
    const NetNamespace& network = link->network(home(side));
    run_inside(network, {"install", "-m", "600", tunnel(side).file, installed(side)});
    ends.push_back(std::make_unique<WireguardTunnel>(network, installed(side)));
  }
  void begin_at_hub(Side side, const std::string& hubs_public_key) {
    std::string conf = with(content_of(tunnel(side).file), "PublicKey", hubs_public_key);
    conf = with(conf, "Endpoint", TwoHomes::address(Home::child) + ":" + std::to_string(port));
    conf = with(conf, "PersistentKeepalive", "25");
    std::ofstream(installed(side)) << with(conf, "ListenPort", "");
    ends.push_back(std::make_unique<WireguardTunnel>(link->network(home(side)), installed(side)));
  }
  // As deploy/firewall/telehug.nft would be set up on that PC.
  void put_up_firewall(Side side) const {
    std::string rules = content_of(TELEHUG_SOURCE "/deploy/firewall/telehug.nft");
    const unsigned first = 7400 + 250 * link->pair.domain();
    rules = replaced(rules, "{ 10.77.0.2 }", "{ " + tunnel(side).peer_address + " }");
    rules = replaced(rules, "{ 26650-26679 }\n", fmt::format("{{ {}-{} }}\n", first, first + 29));
    run_inside(link->network(home(side)), {"nft", rules});
  }

  std::string wearer_at = TwoHomes::address(Home::child) + ":" + std::to_string(port);
  std::unique_ptr<FaultyLink> link;
  std::vector<std::unique_ptr<WireguardTunnel>> ends;
};

class WireguardHub : public Wireguard {
 protected:
  void connect() override {
    link->hide(Home::parent);
    link->hide(Home::child);
  }
};

class WireguardOverIpv6 : public Wireguard {
 protected:
  WireguardOverIpv6() { wearer_at = "2001:db8::2"; }
  void connect() override {
    for (const auto& [home, address] :
         {std::pair(Home::parent, "2001:db8::1/64"), std::pair(Home::child, "2001:db8::2/64")})
      run_inside(link->network(home), {"ip", "address", "add", address, "dev", "home", "nodad"});
    link->homes.take_address(Home::parent);
    link->homes.take_address(Home::child);
  }
};

TEST_F(Wireguard, CarriesTouchesBetweenPcsThatNothingElseReaches) {
  begin(Side::passive);
  begin(Side::active);
  ASSERT_TRUE(link->start_all()) << link->pair.logs();

  const FaultRow row = link->interrupt(
      "way under the tunnel cut for 3 s", FaultyLink::Since::last_arrival, 3s,
      [this] { link->homes.set_both({.loss = 1}); }, [this] { link->homes.set_both({}); });
  fmt::print("\n{}\n", table_text({row}));
  ASSERT_TRUE(row.off_after_ms && row.back_after_s) << link->pair.logs();
  EXPECT_LE(*row.off_after_ms, longest_off_ms);
  EXPECT_LE(*row.back_after_s, longest_back_s);
}

TEST_F(Wireguard, MayBeBegunAfterTheDaemons) {
  link->pair.start_jacket();
  link->start_passive();
  link->pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  link->start_active();
  EXPECT_FALSE(eventually([this] { return link->pair.felt(); }, 3s));
  begin(Side::passive);
  begin(Side::active);
  EXPECT_TRUE(eventually([this] { return link->pair.felt(); })) << link->pair.logs();
}

TEST_F(Wireguard, BehindTheFirewallCarriesTouchesAndNothingElse) {
  begin(Side::passive);
  begin(Side::active);
  const Echo something(link->network(Home::child));
  const auto heard = [&] {
    return round_trip_us(link->network(Home::parent), tunnel(Side::active).peer_address, something.port());
  };
  EXPECT_TRUE(heard());
  put_up_firewall(Side::passive);
  put_up_firewall(Side::active);
  EXPECT_FALSE(heard());
  EXPECT_TRUE(link->start_all()) << link->pair.logs();
}

// The hub runs at the child's provider, whose address both dial; no router forwards anything.
TEST_F(WireguardHub, CarriesTouchesBetweenPcsOfWhichNeitherCanBeDialled) {
  const NetNamespace& hub = link->homes.network(Home::child);
  const TunnelEnd end = make_tunnel_end("");
  const auto peer = [this](Side side, Side others) {
    const std::string conf = content_of(tunnel(others).file);
    const std::string begin = "PublicKey = ";
    return fmt::format("[Peer]\nPublicKey = {}\nAllowedIPs = {}/32\n", conf.substr(conf.find(begin) + begin.size(), 44),
                       tunnel(side).own_address);
  };
  const auto file = link->pair.folder.write(
      "hub.conf", fmt::format("[Interface]\nPrivateKey = {}\nListenPort = {}\n{}{}", end.secret_key, port,
                              peer(Side::active, Side::passive), peer(Side::passive, Side::active)));
  std::filesystem::permissions(file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  ends.push_back(std::make_unique<WireguardTunnel>(hub, file));
  run_inside(hub, {"nft", "insert rule ip router through iifname \"hub\" accept"});
  begin_at_hub(Side::passive, end.offer.public_key);
  begin_at_hub(Side::active, end.offer.public_key);
  EXPECT_TRUE(link->start_all()) << link->pair.logs();
}

TEST_F(WireguardOverIpv6, CarriesTouchesBetweenHomesWithoutIpv4) {
  begin(Side::passive);
  begin(Side::active);
  EXPECT_TRUE(link->start_all()) << link->pair.logs();
}

// Not judged: it tells what the tunnel costs on this PC.
TEST_F(Wireguard, AddsADelayThatIsPrinted) {
  begin(Side::passive);
  begin(Side::active);
  const Echo in_tunnel(link->network(Home::child));
  const auto through = round_trip_us(link->network(Home::parent), tunnel(Side::active).peer_address, in_tunnel.port());
  ASSERT_TRUE(through);
  const Echo beside(link->homes.network(Home::child));
  link->homes.let_only_pass(beside.port());
  const auto without = round_trip_us(link->network(Home::parent), TwoHomes::address(Home::child), beside.port());
  ASSERT_TRUE(without);
  fmt::print("round trip of 400 bytes, p50: {:.0f} us through the tunnel, {:.0f} us without it\n", *through, *without);
}

}  // namespace
}  // namespace telehug
