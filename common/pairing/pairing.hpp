// SPDX-License-Identifier: Apache-2.0
//
// How two PCs become a pair. The wearer's PC (passive side) is the authority of its pairs, since what is felt is the
// wearer's to grant. Two texts travel, by the pairing connection or through any chat window:
//
//   parent's PC  -- request: name, certificate signing request -->  wearer's PC
//   parent's PC  <-- grant: certificates, signed permissions  ---  wearer's PC
//
// Private keys never leave the PC that made them. Both texts are from outside: they are checked before use.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "common/messages.hpp"
#include "common/result.hpp"
#include "dds/settings.hpp"

namespace telehug {

using WallTime = std::chrono::sys_seconds;  // certificates know nothing else

[[nodiscard]] inline WallTime wall_time() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

struct Pair {
  std::string id;            // 16 hexadecimal digits, the same on both PCs
  std::string name;          // of the other person, as they gave it
  Side side = Side::active;  // which side this PC is
  std::string partition;     // "telehug-" and the id
  WallTime expires{};        // when the first of its certificates and permissions ends
  std::string phrase;        // the same words on both PCs; whoever compares them knows that nobody sits in between
  DdsSecurityFiles files;
};

struct PairingFault {
  std::filesystem::path file;
  std::string what;   // one sentence
  std::string to_do;  // the command that mends it
};

// All pairs of this PC and, on the wearer's PC, the authority that signs for them. Folder 0700, secrets 0600.
class PairStore {
 public:
  // `folder` is made when something is first kept in it. Throws std::runtime_error (a sentence) if it can't be used.
  PairStore(std::filesystem::path folder, Side side);

  // --- parent's PC (active side) ---

  // Makes a key and asks for a certificate of it. `name`: how the wearer sees this person, 1 to 64 characters.
  // `reachable_at`: where the other PC can dial this one, if there is to be a WireGuard tunnel to here (see
  // wireguard.hpp); the same below. One side that says so is enough for both to have it.
  [[nodiscard]] Result<std::string> request(const std::string& name, const std::string& reachable_at = "");
  // Takes what the wearer's PC answered to the last request of this PC.
  [[nodiscard]] Result<Pair> accept(const std::string& grant, WallTime now);

  // --- wearer's PC (passive side) ---

  struct Granted {
    Pair pair;
    std::string grant;  // to be sent back
  };
  // `name`: how the parent's PC calls this wearer.
  [[nodiscard]] Result<Granted> grant(const std::string& request, const std::string& name, WallTime now,
                                      const std::string& reachable_at = "");

  // --- either ---

  // Throws std::runtime_error (a sentence) if a pair is there and can't be read.
  [[nodiscard]] std::vector<Pair> list() const;
  // Takes the pair's files away, overwriting its secrets; its id can't be used again on this PC. False: no such pair.
  bool revoke(const std::string& id);
  // What is wrong with the files of a pair: chain, dates, key, subject, signatures, topics and partition. Empty:
  // nothing.
  [[nodiscard]] std::vector<PairingFault> preflight(const Pair& pair, WallTime now) const;

 private:
  std::filesystem::path folder_;
  Side side_;
};

}  // namespace telehug
