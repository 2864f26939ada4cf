// SPDX-License-Identifier: Apache-2.0
//
// How two PCs become a pair. The wearer's PC (passive side) is the authority of its pairs, since what is felt is the
// wearer's to grant. Two texts travel, by the pairing connection or through any chat window:
//
//   parent's PC  -- request: name, certificate signing request -->  wearer's PC
//   parent's PC  <-- grant: certificates, signed permissions  ---  wearer's PC
//
// Before certificates and permissions end, the wearer's PC renews them: a third text, by hand or over the link itself.
//
// Private keys never leave the PC that made them. The texts are from outside: they are checked before use.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
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

// What lets a parent's PC go on in its pair: for the same key and name, valid for longer.
struct Renewal {
  std::string pair;         // its id
  std::string certificate;  // PEM
  std::string permissions;  // S/MIME
};

// As a text that survives a chat window, and back.
[[nodiscard]] std::string to_text(const Renewal& renewal);
[[nodiscard]] Result<Renewal> parse_renewal(const std::string& text);
// Is it rather a renewal than a grant?
[[nodiscard]] bool is_renewal(const std::string& text);

// The pair as its files tell now: it may have been renewed. As it was given if they can't be read.
[[nodiscard]] Pair present(const Pair& pair);

struct PairingFault {
  std::filesystem::path file;
  std::string what;      // one sentence
  std::string to_do;     // the command that mends it
  bool by_date = false;  // nothing but the time is wrong: it passes when the pair is renewed or the clock is right
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

  // Makes new certificates and permissions for both sides, keeps the wearer's own at once and the parent's to be sent.
  // A crash on the way leaves a pair that works and can be renewed again.
  [[nodiscard]] Result<Renewal> renew(const Pair& pair, WallTime now);
  // The newest one, which the parent's PC may not have yet; nothing if the pair was never renewed.
  [[nodiscard]] std::optional<Renewal> newest_renewal(const Pair& pair) const;
  // When the first of what both sides have ends, as far as this PC knows.
  [[nodiscard]] WallTime first_end(const Pair& pair) const;

  // --- parent's PC again ---

  // Takes what the wearer's PC renewed: the pair as it is then, or nothing if what is there is valid as long.
  [[nodiscard]] Result<std::optional<Pair>> install(const Renewal& renewal, WallTime now);

  // --- either ---

  // Throws std::runtime_error (a sentence) if a pair is there and can't be read.
  [[nodiscard]] std::vector<Pair> list() const;
  [[nodiscard]] std::optional<Pair> find(const std::string& id) const;
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
