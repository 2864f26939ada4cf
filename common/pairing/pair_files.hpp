// SPDX-License-Identifier: Apache-2.0
//
// Where the files of pairs lie in the store's folder. Each is replaced whole, one after the other: what belongs to a
// pair stays usable in any mixture of older and newer files, since names, keys and authorities never change and every
// file has dates of its own.
#pragma once

#include <optional>

#include "pairing/pairing.hpp"

namespace telehug {

[[nodiscard]] inline DdsSecurityFiles files_in(const std::filesystem::path& folder) {
  return {folder / "identity_ca.pem",    folder / "certificate.pem", folder / "private_key.pem",
          folder / "permissions_ca.pem", folder / "governance.p7s",  folder / "permissions.p7s"};
}

// What the wearer's PC keeps beside them, to renew the pair.
struct RenewalFiles {
  std::filesystem::path identity_key;
  std::filesystem::path permissions_key;
  std::filesystem::path parents_certificate;  // the first one, for the parent's public key
  std::filesystem::path newest;               // renewal for the parent's PC, if there was one
};

[[nodiscard]] inline RenewalFiles renewal_files_in(const std::filesystem::path& folder) {
  return {folder / "identity_ca.key", folder / "permissions_ca.key", folder / "parent.pem", folder / "renewal.txt"};
}

[[nodiscard]] inline std::filesystem::path folder_of(const Pair& pair) {
  return pair.files.private_key.parent_path();
}

[[nodiscard]] inline std::string partition_of(const std::string& id) {
  return "telehug-" + id;
}

// The name in the certificate of that side.
[[nodiscard]] inline std::string member_name(Side side, const std::string& id) {
  return (side == Side::active ? "parent-" : "wearer-") + id;
}

// What is kept of a pair beside its secrets: ID/pair.json, without which there is no pair.
void keep_about(const Pair& pair);
// Nothing if the pair was never finished. Throws std::runtime_error (a sentence) if it was and can't be read: whoever
// has it must not go on as if there were none.
[[nodiscard]] std::optional<Pair> read_pair(const std::filesystem::path& folder, Side side);

}  // namespace telehug
