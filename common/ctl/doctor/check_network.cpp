// SPDX-License-Identifier: Apache-2.0
//
// Between the two PCs: clock, ports, firewall, the other PC, pairs.
#include <fmt/core.h>

#include <algorithm>

#include "ctl/doctor/checks.hpp"
#include "ctl/doctor/firewall.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

// DDSI-RTPS 2.2, 9.6.1.1: port base 7400, domain gain 250; two for each of fifteen participants.
constexpr int ports_of_a_domain = 30;

int first_port(const SideFacts& side) {
  return 7400 + 250 * side.domain;
}

Finding firewall_finding(const DoctorFacts& facts, int port) {
  const int last = port + ports_of_a_domain - 1;
  const auto closing = closing_chain(*facts.firewall, port);
  const std::string let_in =
      closing ? fmt::format(
                    "let UDP ports {} to {} in from the other PC, whose address stands for PEER: {} (and keep "
                    "that over the next start); /usr/share/doc/telehug-common/docs/between-homes.md",
                    port, last, opening_command(*closing, "PEER", port, last))
              : "";
  switch (judge_firewall(*facts.firewall, port)) {
    case FirewallVerdict::keeps_out:
      return {"firewall", Level::fail, fmt::format("it keeps out what comes to UDP port {}", port), let_in};
    case FirewallVerdict::lets_some_in:
      return {"firewall", Level::ok, fmt::format("it lets some in to UDP port {}, by address or interface", port), {}};
    case FirewallVerdict::lets_in:
      break;
  }
  return {"firewall", Level::ok, fmt::format("lets UDP port {} in", port), {}};
}

Finding peer_finding(const PeerProbe& probe) {
  switch (probe.answer) {
    case PeerAnswer::no_route:
      return {"peer", Level::fail, fmt::format("there is no way to {} from this PC", probe.address),
              "connect this PC to the network (or bring up the tunnel); else correct peer.addresses"};
    case PeerAnswer::unreachable:
      return {"peer", Level::fail, fmt::format("{} is not there", probe.address),
              "switch the other PC on and connect it; else correct peer.addresses"};
    case PeerAnswer::refused:
      return {"peer", Level::fail, fmt::format("{} is there, but telehug does not run on it", probe.address),
              "start telehug on the other PC: `telehug doctor` there; and compare peer.domain"};
    case PeerAnswer::silent:
      break;
  }
  return {"peer", Level::ok, fmt::format("{} does not refuse", probe.address), {}};
}

}  // namespace

Findings check_clock(const DoctorFacts& facts) {
  if (!facts.clock_synchronised) return {};
  if (*facts.clock_synchronised) return {{"clock", Level::ok, "synchronised", {}}};
  return {{"clock", Level::warn, "this PC's clock is not synchronised; a wrong date makes certificates invalid",
           "sudo timedatectl set-ntp true"}};
}

Findings check_ports(const DoctorFacts& facts) {
  Findings findings;
  const auto is_denied = [](const SideFacts& side) { return !side.denied_socket.empty(); };
  const bool all_told = facts.daemons.empty() && std::ranges::none_of(facts.sides, is_denied);
  for (const SideFacts& side : facts.sides) {
    if (talks(facts, side.side) || is_denied(side)) continue;  // they are its own
    const int first = first_port(side);
    const auto of_domain = [&](int port) { return port >= first && port < first + ports_of_a_domain; };
    const auto taken = std::ranges::find_if(facts.udp_ports, of_domain);
    if (taken != facts.udp_ports.end() && all_told)
      findings.push_back({"ports", Level::warn,
                          fmt::format("another program uses the UDP port {} of telehug's", *taken),
                          "`ss -ulpn` tells which; end it, or set peer.domain to another number on both PCs"});
    if (side.web_port != 0 && std::ranges::find(facts.tcp_ports, side.web_port) != facts.tcp_ports.end())
      findings.push_back(
          {"ports", Level::fail, fmt::format("another program listens on TCP port {}, web.port", side.web_port),
           fmt::format("`ss -tlpn` tells which; end it, or set web.port of telehug-{} to 0", side_name(side.side))});
  }
  if (findings.empty() && !facts.sides.empty())
    findings.push_back({"ports", Level::ok, "telehug's are free, or its own", {}});
  return findings;
}

Findings check_firewall(const DoctorFacts& facts) {
  if (std::ranges::all_of(facts.sides, &SideFacts::loopback_only)) return {};
  if (facts.firewall_is_secret)
    return {{"firewall", Level::warn, "this user may not read its rules",
             "run `sudo telehug doctor` to have them checked"}};
  Findings findings;
  if (facts.legacy_firewall)
    findings.push_back({"firewall", Level::warn, "there are rules of the old iptables, which are not looked at",
                        "`sudo iptables-legacy -L INPUT -n` shows them; move them to nftables"});
  if (!facts.firewall) return findings;
  std::vector<int> ports;
  for (const SideFacts& side : facts.sides)
    if (!side.loopback_only && std::ranges::find(ports, first_port(side)) == ports.end())
      ports.push_back(first_port(side));
  for (const int port : ports)
    findings.push_back(firewall_finding(facts, port));
  return findings;
}

Findings check_peers(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides)
    for (const PeerProbe& probe : side.peers)
      findings.push_back(peer_finding(probe));
  return findings;
}

Findings check_pairs(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides) {
    if (side.pairs_secret) {
      findings.push_back(
          {"pairs", Level::warn,
           fmt::format("{}: they are {}'s, and not for this user to read", side_name(side.side), side.account.name),
           "sudo telehug doctor --system"});
      continue;
    }
    if (!side.pairs_trouble.empty()) {
      if (!side.state.usable) continue;  // which is told by itself
      findings.push_back(
          {"pairs", Level::fail, side.pairs_trouble, "run it as the user whose pairs they are: " + side.state.owner});
      continue;
    }
    if (side.pairs.empty())
      findings.push_back({"pairs", Level::warn,
                          side_name(side.side) + ": there is no pair: only this PC itself is heard",
                          (side.account.self ? "" : "sudo ") +
                              std::string("telehug pair invite here, telehug pair accept on the other PC")});
    for (const PairFacts& pair : side.pairs) {
      for (const auto& [what, fix] : pair.faults)
        findings.push_back({"pairs", Level::fail, fmt::format("{}: {}", pair.id, what), fix});
      if (!pair.faults.empty()) continue;
      if (pair.days_left < 14)
        findings.push_back({"pairs", Level::warn, fmt::format("{} ends in {:.0f} days", pair.id, pair.days_left),
                            "let both PCs connect, which renews it; by hand: telehug pair renew on the wearer's PC"});
      else
        findings.push_back(
            {"pairs", Level::ok, fmt::format("{} is valid for {:.0f} days", pair.id, pair.days_left), {}});
    }
  }
  return findings;
}

}  // namespace telehug
