// SPDX-License-Identifier: Apache-2.0
//
// A pair's two authorities: one says who somebody is, the other what they may do. They sign for this pair alone: Fast
// DDS 2.9 checks the topics of a remote side against its permissions, but not its partitions, so that with authorities
// in common one pair's parent could enter another's.
#pragma once

#include <chrono>

#include "pairing/certificates.hpp"
#include "pairing/pair_files.hpp"
#include "pairing/permissions.hpp"

namespace telehug {

inline constexpr auto clocks_differ = std::chrono::hours(24);  // two PCs' clocks, at most

// Of what a pair's members get from `now` on: a year.
[[nodiscard]] inline Validity members_validity(WallTime now) {
  return {now - clocks_differ, now + std::chrono::hours(24 * 365)};
}

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

// What makes the holder of a key one side of a pair.
struct Member {
  std::string certificate;  // PEM
  std::string permissions;  // S/MIME
};

// Throws std::runtime_error if OpenSSL can't.
[[nodiscard]] inline Member admit(const std::string& pair, Side side, EVP_PKEY* key, const Authority& identity,
                                  const Authority& permitting, const Validity& validity) {
  const CertificateHandle certificate =
      issue(key, member_name(side, pair), identity.certificate.get(), identity.key.get(), validity);
  const std::string document = permissions(side, subject_of(certificate.get()), partition_of(pair), validity);
  return {pem_of(certificate.get()), sign(document, permitting.certificate.get(), permitting.key.get())};
}

}  // namespace telehug
