// SPDX-License-Identifier: Apache-2.0
//
// Pairs that `telehug pair` would not make, signed as it signs.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "pairing/authority.hpp"
#include "pairing/certificates.hpp"
#include "pairing/pair_files.hpp"
#include "pairing/pairing.hpp"
#include "pairing/permissions.hpp"
#include "pairing/secret_files.hpp"

namespace telehug {

using Words = std::function<std::string(std::string)>;

struct CraftedSide {
  Validity certificate{wall_time() - std::chrono::hours(24 * 20), wall_time() + std::chrono::hours(24 * 30)};
  Validity permissions = certificate;
  // What becomes of the document before it is signed.
  Words permitted = [](std::string document) { return document; };
};

// Both ends of a pair, in the folders of the two PCs' stores.
class CraftedPair {
 public:
  // `id`: 16 hexadecimal digits. `authorities`: how long they live.
  CraftedPair(std::string id, const Validity& authorities)
      : id_(std::move(id)),
        identities_(make_authority_of(id_, "identities", authorities)),
        permissions_(make_authority_of(id_, "permissions", authorities)) {}
  explicit CraftedPair(std::string id)
      : CraftedPair(std::move(id),
                    {wall_time() - std::chrono::hours(24 * 100), wall_time() + std::chrono::hours(24 * 100)}) {}

  void keep(const std::filesystem::path& store, Side side, const CraftedSide& wish = {}) const {
    const std::filesystem::path folder = store / id_;
    const DdsSecurityFiles files = files_in(folder);
    const KeyHandle key = make_key();
    const CertificateHandle certificate = issue(key.get(), (side == Side::active ? "parent-" : "wearer-") + id_,
                                                identities_.certificate.get(), identities_.key.get(), wish.certificate);
    const auto sign_document = [&](const std::string& document) {
      return sign(document, permissions_.certificate.get(), permissions_.key.get());
    };
    make_secret_folder(store);
    make_secret_folder(folder);
    write_secret(files.private_key, pem_of(key.get()));
    write_secret(files.certificate, pem_of(certificate.get()));
    write_secret(files.identity_ca, pem_of(identities_.certificate.get()));
    write_secret(files.permissions_ca, pem_of(permissions_.certificate.get()));
    write_secret(files.governance, sign_document(governance()));
    write_secret(files.permissions, sign_document(wish.permitted(permissions(side, subject_of(certificate.get()),
                                                                             partition_of(id_), wish.permissions))));
    write_secret(folder / "pair.json", nlohmann::json{{"version", 1},
                                                      {"id", id_},
                                                      {"name", side == Side::active ? "Mia" : "Grandma"},
                                                      {"phrase", "crafted by a test"},
                                                      {"expires", wish.certificate.until.time_since_epoch().count()}}
                                           .dump());
  }

 private:
  std::string id_;
  Authority identities_;
  Authority permissions_;
};

}  // namespace telehug
