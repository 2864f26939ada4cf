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

class Inspection {
 public:
  Inspection(const Pair& pair, WallTime now) : pair_(pair), now_(now) {}

  std::vector<PairingFault> run() {
    const auto identity_ca = certificate(pair_.files.identity_ca);
    const auto own = certificate(pair_.files.certificate);
    const auto permissions_ca = certificate(pair_.files.permissions_ca);
    inspect_key(own.get());
    if (own) inspect_end(validity_of(own.get()).until);
    for (const auto& [authority, file] : {std::pair(identity_ca.get(), pair_.files.identity_ca),
                                          std::pair(permissions_ca.get(), pair_.files.permissions_ca)})
      if (authority != nullptr && !signs_itself(authority)) add(file, "it is not signed with its own key.", pair_again);
    if (identity_ca && own && !issued_by(own.get(), identity_ca.get()))
      add(pair_.files.certificate, "it was not issued by the pair's identity authority.", pair_again);
    if (permissions_ca && own) inspect_documents(own.get(), permissions_ca.get());
    return std::move(faults_);
  }

 private:
  void add(const std::filesystem::path& file, std::string what, std::string to_do) {
    faults_.push_back({file, std::move(what), std::move(to_do)});
  }

  CertificateHandle certificate(const std::filesystem::path& file) {
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
    if (now_ < validity.from) {
      add(file, fmt::format("it is not valid before {}.", date(validity.from)), "check this PC's clock: `date`");
    }
    if (now_ >= validity.until) add(file, fmt::format("it has expired on {}.", date(validity.until)), pair_again);
    return certificate;
  }

  void inspect_key(X509* own) {
    const std::filesystem::path& file = pair_.files.private_key;
    const KeyHandle key = read_key(read_secret(file));
    if (!key) {
      add(file, "it is missing or holds no key, or can't be read by this user.", pair_again);
      return;
    }
    if (own != nullptr && !belongs_to(own, key.get())) add(file, "it is not the certificate's key.", pair_again);
    struct stat about {};
    if (stat(file.c_str(), &about) == 0 && (about.st_mode & 077U) != 0) {
      add(file, "other users can read it.", fmt::format("chmod 600 {}", file.string()));
    }
  }

  // By it a running daemon knows when the pair is over.
  void inspect_end(WallTime end) {
    if (pair_.expires != end)
      add(pair_.files.certificate.parent_path() / "pair.json",
          fmt::format("it says that the pair ends on {}, and the certificate ends on {}.", date(pair_.expires),
                      date(end)),
          pair_again);
  }

  void inspect_documents(X509* own, X509* permissions_ca) {
    inspect(pair_.files.governance, permissions_ca, governance(), "it protects otherwise than this telehug does.");
    const std::string expected = permissions(pair_.side, subject_of(own), pair_.partition, validity_of(own));
    inspect(pair_.files.permissions, permissions_ca, expected,
            fmt::format("it does not permit {} what a {} does, in partition {} for as long as the certificate lives.",
                        subject_of(own), pair_.side == Side::active ? "parent" : "wearer", pair_.partition));
  }

  // What is signed must be what this telehug would have written: nothing less and nothing more is permitted.
  void inspect(const std::filesystem::path& file, X509* authority, std::string expected, const std::string& otherwise) {
    const std::string smime = read_secret(file);
    if (smime.empty()) {
      add(file, "it is missing, empty or can't be read by this user.", pair_again);
      return;
    }
    const auto document = read_signed(smime, authority);
    if (!document) {
      add(file, document.error().message + ".", pair_again);
      return;
    }
    std::string found = *document;
    std::erase(found, '\r');  // S/MIME's line ends
    if (found != expected) add(file, otherwise, pair_again);
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
