// SPDX-License-Identifier: Apache-2.0
//
// A pair's two authorities: one says who somebody is, the other what they may do. They sign for this pair alone, and
// their keys are never stored: Fast DDS 2.9 checks the topics of a remote side against its permissions, but not its
// partitions, so that with authorities in common one pair's parent could enter another's.
#pragma once

#include "pairing/certificates.hpp"

namespace telehug {

struct Authority {
  CertificateHandle certificate;
  KeyHandle key;
};

// Throws std::runtime_error if OpenSSL can't.
[[nodiscard]] inline Authority make_authority_of(const std::string& pair, const char* what, const Validity& validity) {
  KeyHandle key = make_key();
  CertificateHandle certificate = make_authority(key.get(), pair + " " + what, validity);
  return {std::move(certificate), std::move(key)};
}

}  // namespace telehug
