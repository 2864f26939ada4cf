// SPDX-License-Identifier: Apache-2.0
//
// After a change here: cmake --build --preset release --target config_files
#include "config/key_rows.hpp"

#include <algorithm>

#include "config/locator.hpp"

namespace telehug {
namespace {

// Above 100 the UDP ports of a DDS domain (7400 + 250 * domain) lie where the kernel hands out ports of its own.
constexpr Range dds_domain{0, 100};
// There must be a next one.
constexpr Range forwarded_port{0, 65534};

// In DDS these characters make a partition's name a pattern that matches other pairs' partitions.
std::optional<std::string> not_a_pattern(std::string_view text) {
  if (text.find_first_of("*?[]") == std::string_view::npos && text.size() <= 64) return std::nullopt;
  return "a partition has at most 64 characters and none of * ? [ ]";
}

// sockaddr_un has room for 108 bytes.
std::optional<std::string> fits_a_socket(std::string_view text) {
  if (text.size() < 108 && (text.empty() || text.starts_with('/'))) return std::nullopt;
  return "the path of a socket is absolute and shorter than 108 bytes";
}

}  // namespace

void append(Rows& rows, const Rows& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

Rows peer_rows(PeerConfig& c) {
  return {
      {"peer", "domain", &c.domain, "", dds_domain, "DDS domain; both sides need the same."},
      {"peer", "partition", &c.partition, "", TextCheck(not_a_pattern),
       "Name of this pair; both sides need the same. Pairs on one network take different names."},
      {"peer",
       "loopback_only",
       &c.loopback_only,
       "",
       {},
       "true: talk only to a peer on this PC, even if paired. Without a pair the network is never used."},
      {"peer", "pairs", &c.pairs, "", parsed_by(parse_pairs),
       "Which pairs this PC speaks to, by their ids (`telehug pair list`) with commas between them, or \"all\"; empty: "
       "on the wearer's PC all, on a parent's the only one."},
      {"peer",
       "pairs_folder",
       &c.pairs_folder,
       "",
       {},
       "Where the pairs of this PC are kept; empty: in the state folder of the service or user."},
      {"peer", "addresses", &c.addresses, "", parsed_by(parse_addresses),
       "IPv4 addresses of the other side, with commas between them, where it is not found by itself; \"ADDRESS:PORT\" "
       "if it has a public_port."},
      {"peer", "public_address", &c.public_address, "", parsed_by(parse_address),
       "IPv4 address by which the internet knows this home, if its router forwards two UDP ports to this PC; empty: "
       "none. docs/between-homes.md has the safer way."},
      {"peer", "public_port", &c.public_port, "", forwarded_port,
       "The first of the two forwarded ports, the next one being the second; 0 without public_address."},
  };
}

Rows common_rows(ControlConfig& control, WebConfig& web, LogConfig& log) {
  return {
      {"control", "socket", &control.socket, "", TextCheck(fits_a_socket),
       "Local socket that `telehug status` talks to; empty: in the runtime folder of the service or user."},
      {"control",
       "group",
       &control.group,
       "",
       {},
       "Group that may use the socket of a daemon that a person starts, one of theirs; empty: the daemon's own. The "
       "packaged service takes none: `sudo usermod -aG telehug NAME` instead."},
      {"control",
       "stop_file",
       &control.stop_file,
       "",
       {},
       "File that keeps a stop over restarts until it is resumed; empty: in the state folder of the service or user. A "
       "second daemon of a side on one PC needs its own."},
      {"web",
       "enabled",
       &web.enabled,
       "",
       {},
       "true: `telehug open` shows this side's pages in the browser of this PC; nobody else can reach them."},
      {"web", "port", &web.port, "", Range{0, 65535}, "TCP port of the pages, on 127.0.0.1 alone; 0: any free one."},
      {"web",
       "metrics",
       &web.metrics,
       "",
       {},
       "true: /metrics on that port tells any program and user of this PC counters and latencies (OpenMetrics), "
       "without a cookie; give the port a number then."},
      {"log", "level", &log.level, "", OneOf{{"trace", "debug", "info", "warn", "error"}},
       "The least important messages that are logged."},
  };
}

std::string place_of(const std::vector<Key>& keys, std::initializer_list<std::string_view> paths) {
  for (const std::string_view path : paths) {
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.path() == path; });
    if (key != keys.end() && !key->origin.empty()) return key->origin;
  }
  return "defaults";
}

std::vector<Fault> impossible_peers(const PeerConfig& c, const std::vector<Key>& keys) {
  std::vector<Fault> faults;
  if (c.loopback_only && !c.addresses.empty()) {
    faults.push_back({place_of(keys, {"peer.addresses", "peer.loopback_only"}),
                      "peer.addresses are of the network, which peer.loopback_only = true forbids: set it to false, or "
                      "leave the addresses out"});
  }
  if (c.loopback_only && !c.public_address.empty()) {
    faults.push_back({place_of(keys, {"peer.public_address", "peer.loopback_only"}),
                      "peer.public_address is of the network, which peer.loopback_only = true forbids: set it to "
                      "false, or leave the address out"});
  }
  if (c.public_address.empty() != (c.public_port == 0)) {
    faults.push_back({place_of(keys, {"peer.public_address", "peer.public_port"}),
                      "peer.public_address and peer.public_port belong together: give both, or neither"});
  }
  return faults;
}

}  // namespace telehug
