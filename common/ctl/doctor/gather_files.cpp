// SPDX-License-Identifier: Apache-2.0
//
// The folder of what a side keeps, and its pairs.
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "config/places.hpp"
#include "ctl/doctor/checks.hpp"
#include "ctl/doctor/gather.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

FolderFacts folder_at(const fs::path& folder, const Account& account) {
  FolderFacts facts;
  facts.path = folder.string();
  std::error_code ignored;
  facts.there = fs::exists(folder, ignored);
  fs::path existing = folder;
  while (!existing.empty() && existing != "/" && !fs::exists(existing, ignored))
    existing = existing.parent_path();
  facts.usable = may(account, existing, W_OK | X_OK);
  struct stat status {};
  if (::stat(existing.c_str(), &status) == 0) {
    facts.owner = name_of_user(status.st_uid);
    facts.open_to_all = facts.there && (status.st_mode & 0077) != 0;
  }
  struct statvfs space {};
  if (::statvfs(existing.c_str(), &space) == 0) facts.free_bytes = std::uint64_t{space.f_bavail} * space.f_frsize;
  return facts;
}

void add_pairs(SideFacts& facts, const fs::path& folder) {
  try {
    const PairStore store(folder, facts.side);
    const WallTime now = wall_time();
    for (const Pair& pair : store.list()) {
      PairFacts& about = facts.pairs.emplace_back();
      about.id = pair.id;
      about.days_left = std::chrono::duration<double, std::ratio<86400>>(pair.expires - now).count();
      for (const PairingFault& fault : store.preflight(pair, now))
        about.faults.emplace_back(fault.what, fault.to_do);
    }
  } catch (const std::runtime_error& problem) {
    facts.pairs_trouble = problem.what();
  }
}

}  // namespace

void gather_either(const DoctorFacts& facts, SideFacts& side, const PeerConfig& peer, const WebConfig& web) {
  side.web_port = web.enabled ? web.port : 0;
  if (!talks(facts, side.side)) side.peers = probe_peers(peer.addresses, peer.domain);
  side.domain = peer.domain;
  side.loopback_only = peer.loopback_only;
  const fs::path pairs = pairs_folder(peer, side.side);
  side.state = folder_at(pairs, side.account);
  side.pairs_secret = !side.account.self && ::geteuid() != 0;
  if (!side.pairs_secret) add_pairs(side, pairs);
}

}  // namespace telehug
