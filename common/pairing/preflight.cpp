// SPDX-License-Identifier: Apache-2.0
//
// Fast DDS refuses a pair's files without a reason; this finds it.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "pairing/certificates.hpp"
#include "pairing/pair_files.hpp"
#include "pairing/pairing.hpp"
#include "pairing/permissions.hpp"
#include "pairing/secret_files.hpp"

namespace telehug {
namespace {

constexpr const char* pair_again = "pair the two PCs again: `telehug pair --help`";

std::string date(WallTime time) {
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string renew_it(const Pair& pair) {
  return pair.side == Side::passive
             ? fmt::format(
                   "renew the pair: `telehug pair renew {}`, and its text to `telehug pair finish` on the parent's PC",
                   pair.id)
             : fmt::format(
                   "renew the pair: `telehug pair renew {}` on the wearer's PC, and its text to `telehug pair "
                   "finish` here",
                   pair.id);
}

class Inspection {
 public:
  Inspection(const Pair& pair, WallTime now) : pair_(pair), now_(now) {}

  std::vector<PairingFault> run() {
    const auto identity_ca = certificate(pair_.files.identity_ca, pair_again);
    const auto own = certificate(pair_.files.certificate, renew_it(pair_));
    const auto permissions_ca = certificate(pair_.files.permissions_ca, pair_again);
    inspect_key(own.get());
    for (const auto& [authority, file] : {std::pair(identity_ca.get(), pair_.files.identity_ca),
                                          std::pair(permissions_ca.get(), pair_.files.permissions_ca)})
      if (authority != nullptr && !signs_itself(authority)) add(file, "it is not signed with its own key.", pair_again);
    if (identity_ca && own && !issued_by(own.get(), identity_ca.get()))
      add(pair_.files.certificate, "it was not issued by the pair's identity authority.", pair_again);
    if (permissions_ca && own) inspect_documents(own.get(), permissions_ca.get());
    return std::move(faults_);
  }

 private:
  void add(const std::filesystem::path& file, std::string what, std::string to_do, bool by_date = false) {
    faults_.push_back({file, std::move(what), std::move(to_do), by_date});
  }

  CertificateHandle certificate(const std::filesystem::path& file, const std::string& if_expired) {
    const std::string pem = read_secret(file);
    CertificateHandle certificate = read_certificate(pem);
    if (!certificate) {
      add(file, pem.empty() ? "it is missing, empty or can't be read by this user." : "it holds no certificate.",
          pair_again);
      return certificate;
    }
    if (pem != pem_of(certificate.get()))
      add(file, "it holds more than one certificate, and each would be trusted.", pair_again);
    const Validity validity = validity_of(certificate.get());
    inspect_dates(file, validity, if_expired);
    return certificate;
  }

  void inspect_dates(const std::filesystem::path& file, const Validity& validity, const std::string& if_expired) {
    if (now_ < validity.from)
      add(file, fmt::format("it is not valid before {}.", date(validity.from)), "check this PC's clock: `date`", true);
    if (now_ >= validity.until) add(file, fmt::format("it has expired on {}.", date(validity.until)), if_expired, true);
  }

  void inspect_key(X509* own) {
    const std::filesystem::path& file = pair_.files.private_key;
    const KeyHandle key = read_key(read_secret(file));
    if (!key) {
      add(file, "it is missing or holds no key, or can't be read by this user.", pair_again);
      return;
    }
    if (own != nullptr && !belongs_to(own, key.get())) add(file, "it is not the certificate's key.", pair_again);
    const RenewalFiles authorities = renewal_files_in(folder_of(pair_));
    for (const std::filesystem::path& secret : {file, authorities.identity_key, authorities.permissions_key}) {
      struct stat about {};
      if (stat(secret.c_str(), &about) == 0 && (about.st_mode & 077U) != 0)
        add(secret, "other users can read it.", fmt::format("chmod 600 {}", secret.string()));
    }
  }

  // What is signed must be what this telehug would have written: nothing less and nothing more is permitted.
  void inspect_documents(X509* own, X509* permissions_ca) {
    const auto governing = document(pair_.files.governance, permissions_ca);
    if (governing && *governing != governance())
      add(pair_.files.governance, "it protects otherwise than this telehug does.", pair_again);
    const auto permitting = document(pair_.files.permissions, permissions_ca);
    if (!permitting) return;
    // After a renewal that broke off they may live for another time than the certificate.
    const Validity certified = validity_of(own);
    const Validity permitted = validity_in(*permitting).value_or(certified);
    if (*permitting != permissions(pair_.side, subject_of(own), pair_.partition, permitted)) {
      add(pair_.files.permissions,
          fmt::format("it does not permit {} what a {} does, in partition {}.", subject_of(own),
                      pair_.side == Side::active ? "parent" : "wearer", pair_.partition),
          pair_again);
    } else if (permitted.from != certified.from || permitted.until != certified.until) {
      inspect_dates(pair_.files.permissions, permitted, renew_it(pair_));
    }
  }

  // Nothing if it can't be read or the authority did not sign it, which is then among the faults.
  std::optional<std::string> document(const std::filesystem::path& file, X509* authority) {
    const std::string smime = read_secret(file);
    if (smime.empty()) {
      add(file, "it is missing, empty or can't be read by this user.", pair_again);
      return {};
    }
    const auto document = read_signed(smime, authority);
    if (!document) {
      add(file, document.error().message + ".", pair_again);
      return {};
    }
    std::string found = *document;
    std::erase(found, '\r');  // S/MIME's line ends
    return found;
  }

  const Pair& pair_;
  WallTime now_;
  std::vector<PairingFault> faults_;
};

}  // namespace

std::vector<PairingFault> PairStore::preflight(const Pair& pair, WallTime now) const {
  return Inspection(pair, now).run();
}

}  // namespace telehug
