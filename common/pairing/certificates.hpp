// SPDX-License-Identifier: Apache-2.0
//
// Keys (EC P-256), certificates and signed documents as DDS Security 1.1 (9.3, 9.4) asks for them. PEM in, PEM out; all
// of it is OpenSSL's work.
#pragma once

#include <string>

#include "common/result.hpp"
#include "pairing/openssl_handles.hpp"
#include "pairing/pairing.hpp"

namespace telehug {

struct Validity {
  WallTime from;
  WallTime until;
};

// These throw std::runtime_error if OpenSSL can't (out of memory, no randomness).
[[nodiscard]] KeyHandle make_key();
[[nodiscard]] std::string pem_of(EVP_PKEY* key);  // with the private part
[[nodiscard]] std::string pem_of(X509* certificate);
[[nodiscard]] std::string signing_request(EVP_PKEY* key, const std::string& common_name);
[[nodiscard]] CertificateHandle make_authority(EVP_PKEY* key, const std::string& common_name, const Validity& validity);
[[nodiscard]] CertificateHandle issue(EVP_PKEY* holder, const std::string& common_name, X509* authority,
                                      EVP_PKEY* authority_key, const Validity& validity);
// S/MIME, as `openssl smime -sign -text` makes it.
[[nodiscard]] std::string sign(const std::string& document, X509* authority, EVP_PKEY* authority_key);
// Hexadecimal digits of so many random bytes.
[[nodiscard]] std::string random_hex(std::size_t bytes);
[[nodiscard]] std::string sha256(const std::string& bytes);
[[nodiscard]] std::string der_of(X509* certificate);
[[nodiscard]] std::string public_der_of(EVP_PKEY* key);

// What is read comes from outside: null if it is not what it should be.
[[nodiscard]] KeyHandle read_key(const std::string& pem);
[[nodiscard]] CertificateHandle read_certificate(const std::string& pem);
// The public key of a request, if it is signed with that key's private part and is an EC key on P-256.
[[nodiscard]] Result<KeyHandle> read_signing_request(const std::string& pem);
// The document, if `authority` signed it.
[[nodiscard]] Result<std::string> read_signed(const std::string& smime, X509* authority);

// By the rules that Fast DDS asks OpenSSL to apply, but for the dates.
[[nodiscard]] bool issued_by(X509* certificate, X509* authority);
[[nodiscard]] bool signs_itself(X509* authority);
[[nodiscard]] bool belongs_to(X509* certificate, EVP_PKEY* key);
[[nodiscard]] Validity validity_of(const X509* certificate);
// "CN=...,O=telehug": the form and order that permissions must have (RFC 2253).
[[nodiscard]] std::string subject_of(const X509* certificate);

}  // namespace telehug
