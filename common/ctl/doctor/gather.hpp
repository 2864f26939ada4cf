// SPDX-License-Identifier: Apache-2.0
//
// The parts of gather_facts(), one a subject, and what they share.
#pragma once

#include <sys/types.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "config/config.hpp"
#include "ctl/doctor/facts.hpp"

namespace telehug {

// Empty if it can't be read.
[[nodiscard]] std::string content_of(const std::filesystem::path& file);
// Sorted; empty if there is no such folder.
[[nodiscard]] std::vector<std::filesystem::path> entries(const std::filesystem::path& folder);

// The user who asks.
[[nodiscard]] Account own_account();
[[nodiscard]] std::string name_of_user(uid_t user);
// May this account do all of `what` (R_OK, W_OK, X_OK)? Asked of the kernel for the user who asks, else told by owner,
// groups and mode.
[[nodiscard]] bool may(const Account& account, const std::filesystem::path& path, int what);

// What a daemon of this account reads, of what the user who asks does.
[[nodiscard]] ConfigSources sources_of(const Account& account, ConfigSources sources);

// Finds its files where the system's unit has them, whoever asks.
class StateOfService {
 public:
  explicit StateOfService(bool wanted) : set_(wanted && std::getenv(variable) == nullptr) {
    if (set_) ::setenv(variable, "/var/lib/telehug", 0);
  }
  ~StateOfService() {
    if (set_) ::unsetenv(variable);
  }
  StateOfService(const StateOfService&) = delete;
  StateOfService& operator=(const StateOfService&) = delete;

 private:
  static constexpr const char* variable = "STATE_DIRECTORY";
  bool set_;
};

// A device as the configuration names it: without the root.
[[nodiscard]] DeviceNode device_node(const std::filesystem::path& root, const std::filesystem::path& path,
                                     const Account& account);
// Adds the device of that name if it is there and not yet among them.
void add_named(std::vector<DeviceNode>& nodes, const std::filesystem::path& root, const std::string& name,
               const Account& account);

[[nodiscard]] std::vector<UnitFacts> units_of(Side side, const std::filesystem::path& root);
// The account of the system's unit of that side, if that is what runs or would be started; else the user who asks.
[[nodiscard]] Account account_of(const std::vector<UnitFacts>& units, bool system);

// The sides that this PC has: those that run, are configured, calibrated or paired; else those that are installed.
[[nodiscard]] std::vector<Side> sides_here(const ConfigSources& sources, const std::vector<nlohmann::json>& daemons);
// A program of telehug's: beside this one, else in $PATH; empty if there is none.
[[nodiscard]] std::filesystem::path installed_program(const std::string& name);

// What both sides have: network, pairs, pages.
void gather_either(const DoctorFacts& facts, SideFacts& side, const PeerConfig& peer, const WebConfig& web);
void gather_active(DoctorFacts& facts, const DoctorWishes& wishes, SideFacts& side);
void gather_passive(DoctorFacts& facts, const DoctorWishes& wishes, SideFacts& side);
void gather_network(DoctorFacts& facts, const DoctorWishes& wishes);
// nftables' rules, which root alone may read.
void gather_firewall(DoctorFacts& facts);
// How the configured addresses answer; waits up to 4.5 s for all of them together.
[[nodiscard]] std::vector<PeerProbe> probe_peers(const std::string& addresses, int domain);

}  // namespace telehug
