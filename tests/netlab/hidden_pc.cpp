// SPDX-License-Identifier: Apache-2.0
#include "netlab/hidden_pc.hpp"

#include <fstream>
#include <stdexcept>

#include "netlab/ethernet_port.hpp"
#include "netlab/run_inside.hpp"

namespace telehug {
namespace {

constexpr const char* pcs_address = "192.168.1.2";
constexpr const char* routers_address = "192.168.1.1";

// As a home router does it. "home" leads outwards.
constexpr const char* rules = R"(
add table ip router
add chain ip router outwards { type nat hook postrouting priority 100; }
add rule ip router outwards oifname "home" masquerade
add chain ip router inwards { type nat hook prerouting priority -100; }
add chain ip router through { type filter hook forward priority 0; policy drop; }
add rule ip router through iifname "lan" accept
add rule ip router through ct state established,related accept
add rule ip router through ct status dnat accept
)";

}  // namespace

HiddenPc::HiddenPc(const TwoHomes& homes, Home home) : router_(homes.network(home)) {
  run_inside(router_, {"ip", "link", "add", "lan", "type", "veth", "peer", "name", "home", "netns", path_of(network_)});
  run_inside(router_, {"ip", "address", "add", std::string(routers_address) + "/24", "dev", "lan"});
  run_inside(router_, {"ip", "link", "set", "lan", "up"});
  run_inside(network_, {"ip", "link", "set", "lo", "up"});
  run_inside(network_, {"ip", "link", "set", "home", "up"});
  run_inside(network_, {"ip", "address", "add", std::string(pcs_address) + "/24", "dev", "home"});
  run_inside(network_, {"ip", "route", "add", "default", "via", routers_address});
  write_checksums(router_, "lan");
  write_checksums(network_, "home");
  run_inside(router_, {"nft", rules});
  const InsideNamespace inside(router_);
  if (!(std::ofstream("/proc/sys/net/ipv4/ip_forward") << "1" << std::flush))
    throw std::runtime_error("a router can't be made to forward: /proc/sys can't be written");
}

void HiddenPc::forward(std::uint16_t first_port, std::uint16_t last_port) const {
  run_inside(router_, {"nft", "add rule ip router inwards iifname \"home\" udp dport " + std::to_string(first_port) +
                                  "-" + std::to_string(last_port) + " dnat to " + pcs_address});
}

}  // namespace telehug
