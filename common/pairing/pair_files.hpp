// SPDX-License-Identifier: Apache-2.0
//
// Where the files of pairs lie in the store's folder.
#pragma once

#include "pairing/pairing.hpp"

namespace telehug {

[[nodiscard]] inline DdsSecurityFiles files_in(const std::filesystem::path& folder) {
  return {folder / "identity_ca.pem",    folder / "certificate.pem", folder / "private_key.pem",
          folder / "permissions_ca.pem", folder / "governance.p7s",  folder / "permissions.p7s"};
}

[[nodiscard]] inline std::string partition_of(const std::string& id) {
  return "telehug-" + id;
}

}  // namespace telehug
