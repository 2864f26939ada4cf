// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/messages.hpp"

namespace telehug {

// Above this the ports of a domain (7400 + 250 * domain) lie where the kernel hands out ports of its own.
inline constexpr std::uint32_t max_domain_id = 100;

// What DDS Security asks of a paired side. PEM; governance and permissions are XML in an S/MIME signature.
struct DdsSecurityFiles {
  std::filesystem::path identity_ca;
  std::filesystem::path certificate;
  std::filesystem::path private_key;
  std::filesystem::path permissions_ca;
  std::filesystem::path governance;
  std::filesystem::path permissions;
};

// How somebody beyond this home's router reaches this side: two UDP ports, which the router forwards under the same
// numbers.
struct PublicAddress {
  std::string address;     // IPv4
  std::uint16_t port = 0;  // for discovery; data arrives at the next one
};

struct DdsSettings {
  Side side = Side::active;           // which side this program is: it writes this side's topics and reads the other's
  std::uint32_t domain_id = 0;        // 0..max_domain_id; the same on both sides
  std::string partition = "telehug";  // only equal partitions meet; not empty, no wildcards
  bool loopback_only = true;          // binds to 127.0.0.1 and sends to nothing else
  // IPv4 addresses, for networks without multicast; only if not loopback_only. "192.0.2.7:7600" if the port of the
  // other side's discovery is not the domain's. (g++ wants the initializer.)
  std::vector<std::string> peers = {};  // NOLINT(readability-redundant-member-init)
  // Only if not loopback_only. One participant of a PC can have it.
  std::optional<PublicAddress> public_address = {};  // NOLINT(readability-redundant-member-init)
  // Given: only a side whose files the same authorities signed is heard, and everything is encrypted. The library tells
  // no reason when it refuses them: check them beforehand.
  std::optional<DdsSecurityFiles> security = {};  // NOLINT(readability-redundant-member-init)
};

}  // namespace telehug
