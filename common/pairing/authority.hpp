// SPDX-License-Identifier: Apache-2.0
//
// The wearer's two authorities: one says who somebody is, the other what they may do.
#pragma once

#include <filesystem>

#include "pairing/certificates.hpp"

namespace telehug {

struct Authority {
  CertificateHandle certificate;
  KeyHandle key;
};

struct Authorities {
  Authority identity;
  Authority permissions;
};

// From this folder; made if it is empty. Throws std::runtime_error (a sentence) if they can't be read or made.
[[nodiscard]] Authorities load_or_make_authorities(const std::filesystem::path& folder, WallTime now);

}  // namespace telehug
