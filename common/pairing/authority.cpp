// SPDX-License-Identifier: Apache-2.0
#include "pairing/authority.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>

#include <stdexcept>

#include "pairing/secret_files.hpp"

namespace telehug {
namespace {

constexpr auto lives = std::chrono::hours(24 * 365 * 20);

Authority load_or_make(const std::filesystem::path& folder, const std::string& name, WallTime now) {
  const auto certificate_file = folder / (name + ".pem");
  const auto key_file = folder / (name + ".key");
  std::string key_pem = read_secret(key_file);
  const std::string certificate_pem = read_secret(certificate_file);
  Authority authority;
  if (key_pem.empty() && certificate_pem.empty()) {
    authority.key = make_key();
    // A name of its own: two wearers' authorities must not look like one.
    authority.certificate = make_authority(authority.key.get(), fmt::format("{} {}", name, random_hex(8)),
                                           {now - std::chrono::hours(24), now + lives});
    key_pem = pem_of(authority.key.get());
    make_secret_folder(folder);
    write_secret(key_file, key_pem);
    write_secret(certificate_file, pem_of(authority.certificate.get()));
  } else {
    authority.key = read_key(key_pem);
    authority.certificate = read_certificate(certificate_pem);
  }
  OPENSSL_cleanse(key_pem.data(), key_pem.size());
  if (!authority.key || !authority.certificate || !belongs_to(authority.certificate.get(), authority.key.get())) {
    throw std::runtime_error(fmt::format(
        "the authority of this PC is damaged: {} and {} are no key and its certificate; put back a copy, or move {} "
        "away and pair again",
        key_file.string(), certificate_file.string(), folder.string()));
  }
  return authority;
}

}  // namespace

Authorities load_or_make_authorities(const std::filesystem::path& folder, WallTime now) {
  return {load_or_make(folder, "identity_ca", now), load_or_make(folder, "permissions_ca", now)};
}

}  // namespace telehug
