// SPDX-License-Identifier: Apache-2.0
//
// The renewal of pairs: the wearer's PC signs anew for the keys that it knows, the parent's PC takes what was signed.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/crypto.h>

#include <algorithm>
#include <stdexcept>

#include "pairing/armour.hpp"
#include "pairing/authority.hpp"
#include "pairing/pair_files.hpp"
#include "pairing/pairing.hpp"
#include "pairing/secret_files.hpp"

namespace telehug {
namespace {

constexpr const char* kind = "renewal";

KeyHandle read_kept_key(const std::filesystem::path& file) {
  std::string pem = read_secret(file);
  KeyHandle key = read_key(pem);
  OPENSSL_cleanse(pem.data(), pem.size());
  return key;
}

// Without a key or certificate if it can't be read or the two don't belong together.
Authority read_authority(const std::filesystem::path& certificate, const std::filesystem::path& key) {
  Authority authority{read_certificate(read_secret(certificate)), read_kept_key(key)};
  if (authority.certificate && authority.key && !belongs_to(authority.certificate.get(), authority.key.get()))
    authority.key.reset();
  return authority;
}

bool is_whole(const Authority& authority) {
  return authority.certificate && authority.key;
}

// What the parent's PC is known to have, or is offered.
CertificateHandle parents_certificate(const RenewalFiles& files) {
  if (const auto newest = parse_renewal(read_secret(files.newest))) {
    if (auto certificate = read_certificate(newest->certificate)) return certificate;
  }
  return read_certificate(read_secret(files.parents_certificate));
}

// Any mixture of old and new files works until the older one ends. pair.json comes last, so that the end that it names
// is never later than what is there.
void keep_member(Pair& pair, const Member& member, WallTime expires) {
  write_secret(pair.files.certificate, member.certificate);
  write_secret(pair.files.permissions, member.permissions);
  pair.expires = expires;
  keep_about(pair);
}

std::string date(WallTime time) {
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

Error refused(const std::string& why) {
  return {"the renewal is refused: " + why};
}

}  // namespace

std::string to_text(const Renewal& renewal) {
  return armour(kind, {{"version", 1},
                       {"id", renewal.pair},
                       {"certificate", renewal.certificate},
                       {"permissions", renewal.permissions}});
}

Result<Renewal> parse_renewal(const std::string& text) {
  const auto json = unarmour(kind, text);
  if (!json) return json.error();
  return Renewal{text_in(*json, "id"), text_in(*json, "certificate"), text_in(*json, "permissions")};
}

bool is_renewal(const std::string& text) {
  return holds(kind, text);
}

Result<Renewal> PairStore::renew(const Pair& pair, WallTime now) {
  if (side_ != Side::passive)
    return Error{
        "this is the parent's PC: a pair is renewed on the wearer's (`telehug pair renew`), and what that prints is "
        "taken here (`telehug pair finish`)"};
  try {
    const RenewalFiles kept = renewal_files_in(folder_of(pair));
    const Authority identity = read_authority(pair.files.identity_ca, kept.identity_key);
    const Authority permitting = read_authority(pair.files.permissions_ca, kept.permissions_key);
    const CertificateHandle parents = read_certificate(read_secret(kept.parents_certificate));
    if (!is_whole(identity) || !is_whole(permitting) || !parents)
      return Error{fmt::format(
          "the pair with {} ({}) can't be renewed: what that needs was not kept by the telehug that made it, or is "
          "damaged; `telehug pair revoke {}` and pair the two PCs again",
          pair.name, pair.id, pair.id)};
    const KeyHandle own_key = read_kept_key(pair.files.private_key);
    if (!own_key) return Error{fmt::format("{} is missing or holds no key", pair.files.private_key.string())};

    const Validity authorities = validity_of(identity.certificate.get());
    // From the pairing on, so that a renewal made while a clock was ahead holds when it is right again.
    const Validity validity{authorities.from, std::min(members_validity(now).until, authorities.until)};
    if (const WallTime present_end = first_end(pair); validity.until < present_end || present_end == authorities.until)
      return Error{fmt::format(
          "the pair with {} ({}) is valid until {}, and no longer can be given: check this PC's clock (`date`) or, "
          "when that is near, pair the two PCs again",
          pair.name, pair.id, date(present_end))};
    const auto member = [&](Side side, EVP_PKEY* key) {
      return admit(pair.id, side, key, identity, permitting, validity);
    };
    const Member theirs = member(Side::active, X509_get0_pubkey(parents.get()));
    Renewal renewal{pair.id, theirs.certificate, theirs.permissions};
    // The parent's first: as long as the own files are the old ones, another renewal is due.
    write_secret(kept.newest, to_text(renewal));
    Pair own = pair;
    keep_member(own, member(Side::passive, own_key.get()), validity.until);
    return renewal;
  } catch (const std::exception& problem) {
    return Error{problem.what()};
  }
}

std::optional<Renewal> PairStore::newest_renewal(const Pair& pair) const {
  auto renewal = parse_renewal(read_secret(renewal_files_in(folder_of(pair)).newest));
  if (!renewal) return {};
  return *std::move(renewal);
}

WallTime PairStore::first_end(const Pair& pair) const {
  const auto parents = parents_certificate(renewal_files_in(folder_of(pair)));
  return parents ? std::min(pair.expires, validity_of(parents.get()).until) : pair.expires;
}

Result<std::optional<Pair>> PairStore::install(const Renewal& renewal, WallTime now) {
  if (side_ != Side::active) return Error{"this is the wearer's PC: a renewal is for the parent's"};
  try {
    auto pair = find(renewal.pair);
    if (!pair) return refused("its pair is none of this PC (`telehug pair list`)");
    const auto identity_ca = read_certificate(read_secret(pair->files.identity_ca));
    const auto permissions_ca = read_certificate(read_secret(pair->files.permissions_ca));
    const KeyHandle own_key = read_kept_key(pair->files.private_key);
    if (!identity_ca || !permissions_ca || !own_key)
      return refused("this PC's files of the pair are damaged (`telehug pair list`)");

    const auto certificate = read_certificate(renewal.certificate);
    if (!certificate) return refused("the certificate in it is damaged; ask for it again");
    if (!issued_by(certificate.get(), identity_ca.get()))
      return refused("its certificate is not of the pair's identity authority");
    if (!belongs_to(certificate.get(), own_key.get())) return refused("its certificate is for another key");
    const std::string subject = subject_of(certificate.get());
    if (subject != fmt::format("CN={},O=telehug", member_name(side_, pair->id)))
      return refused("its certificate is for " + subject);
    const Validity validity = validity_of(certificate.get());
    if (validity.until <= pair->expires) return std::optional<Pair>();
    if (now < validity.from)
      return refused(fmt::format("it is not valid before {}; check both PCs' clocks", date(validity.from)));
    if (now >= validity.until)
      return refused(fmt::format("it has expired on {}; ask for a new one", date(validity.until)));

    auto document = read_signed(renewal.permissions, permissions_ca.get());
    if (!document) return refused("its permissions: " + document.error().message);
    std::erase(*document, '\r');  // S/MIME's line ends
    if (*document != permissions(side_, subject, pair->partition, validity))
      return refused("it does not permit what this telehug does; both PCs need the same version");
    // The one certificate that was looked at, and no other that stood behind it.
    keep_member(*pair, {pem_of(certificate.get()), renewal.permissions}, validity.until);
    return pair;
  } catch (const std::exception& problem) {
    return Error{problem.what()};
  }
}

}  // namespace telehug
