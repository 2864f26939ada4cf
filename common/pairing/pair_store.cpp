// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <openssl/crypto.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "common/outside_json.hpp"
#include "common/printable.hpp"
#include "pairing/armour.hpp"
#include "pairing/authority.hpp"
#include "pairing/pair_files.hpp"
#include "pairing/pairing.hpp"
#include "pairing/permissions.hpp"
#include "pairing/phrase.hpp"
#include "pairing/secret_files.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr auto pair_lives = std::chrono::hours(24 * 365);
constexpr auto clocks_differ = std::chrono::hours(24);  // two PCs' clocks, at most
constexpr std::int64_t last_time = 253'402'300'799;     // the end of the year 9999
constexpr std::size_t max_name = 64;
constexpr std::size_t max_pairs = 100;

bool is_id(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= max_name && printable(text);
}

Error bad_name(const std::string& whose) {
  return {fmt::format("{} has 1 to {} bytes of UTF-8 without control characters: choose another one", whose, max_name)};
}

// Empty if it is absent or no text.
std::string text_in(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

// Nothing if it is absent or no time that a calendar knows.
std::optional<WallTime> time_in(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number_unsigned() || *found > last_time) return {};
  return WallTime(std::chrono::seconds(found->get<std::int64_t>()));
}

// What both PCs know and whoever sat between them would have had to replace.
std::string phrase(X509* identity_ca, X509* permissions_ca, EVP_PKEY* parent, EVP_PKEY* wearer) {
  return phrase_of(der_of(identity_ca) + der_of(permissions_ca) + public_der_of(parent) + public_der_of(wearer));
}

// The pair's folder appears whole or not at all. pair.json comes last: without it there is no pair.
void keep(const Pair& pair, const Json& texts, std::string key_pem) {
  const fs::path folder = pair.files.private_key.parent_path();
  make_secret_folder(folder.parent_path());
  make_secret_folder(folder);
  write_secret(pair.files.private_key, key_pem);
  OPENSSL_cleanse(key_pem.data(), key_pem.size());
  write_secret(pair.files.identity_ca, text_in(texts, "identity_ca"));
  write_secret(pair.files.certificate, text_in(texts, "certificate"));
  write_secret(pair.files.permissions_ca, text_in(texts, "permissions_ca"));
  write_secret(pair.files.governance, text_in(texts, "governance"));
  write_secret(pair.files.permissions, text_in(texts, "permissions"));
  const Json about = {{"version", 1},
                      {"id", pair.id},
                      {"name", pair.name},
                      {"phrase", pair.phrase},
                      {"expires", pair.expires.time_since_epoch().count()}};
  write_secret(folder / "pair.json", about.dump(2) + "\n");
}

// Nothing if the pair was never finished. Throws if it was and can't be read: whoever has it must not go on as if there
// were none.
std::optional<Pair> read_pair(const fs::path& folder, Side side) {
  const fs::path file = folder / "pair.json";
  std::error_code none;
  if (fs::status(file, none).type() == fs::file_type::not_found) return {};
  const Json about = parse_outside_json(read_secret(file));
  const std::string id = folder.filename().string();
  const auto expires = time_in(about, "expires");
  if (text_in(about, "id") != id || !expires) {
    throw std::runtime_error(
        fmt::format("{} is damaged or can't be read by this user: run as the user who made the pair, or `telehug pair "
                    "revoke {}` and "
                    "pair the two PCs again",
                    file.string(), id));
  }
  return Pair{id, text_in(about, "name"), side, partition_of(id), *expires, text_in(about, "phrase"), files_in(folder)};
}

}  // namespace

PairStore::PairStore(fs::path folder, Side side) : folder_(std::move(folder)), side_(side) {
  std::error_code problem;
  if (fs::exists(folder_, problem) && !fs::is_directory(folder_, problem))
    throw std::runtime_error(fmt::format("{} is no folder: pairs can't be kept there", folder_.string()));
}

Result<std::string> PairStore::request(const std::string& name) {
  if (side_ != Side::active)
    return Error{"this is the wearer's PC: the request is made on the parent's (`telehug pair request`)"};
  if (!is_name(name)) return bad_name("the name");
  try {
    const KeyHandle key = make_key();
    std::string key_pem = pem_of(key.get());
    make_secret_folder(folder_);
    write_secret(folder_ / "pending.key", key_pem);
    OPENSSL_cleanse(key_pem.data(), key_pem.size());
    return armour("request", {{"version", 1}, {"name", name}, {"request", signing_request(key.get(), "request")}});
  } catch (const std::exception& problem) {
    return Error{problem.what()};
  }
}

Result<PairStore::Granted> PairStore::grant(const std::string& request, const std::string& name, WallTime now) {
  if (side_ != Side::passive)
    return Error{"this is the parent's PC: what is felt is granted on the wearer's (`telehug pair grant`)"};
  if (!is_name(name)) return bad_name("the wearer's name");
  const auto asked = unarmour("request", request);
  if (!asked) return asked.error();
  const std::string parents_name = text_in(*asked, "name");
  if (!is_name(parents_name)) return bad_name("the name in the request");
  const auto parents_key = read_signing_request(text_in(*asked, "request"));
  if (!parents_key) return Error{"the request is refused: " + parents_key.error().message};
  try {
    if (list().size() >= max_pairs)
      return Error{fmt::format("this PC has {} pairs already: revoke one (`telehug pair list`)", max_pairs)};
    make_secret_folder(folder_);
    const std::string id = random_hex(8);
    const std::string partition = partition_of(id);
    const Validity validity{now - clocks_differ, now + pair_lives};
    // They outlive what they sign, so that the certificate is what expires.
    const Validity authorities{validity.from, validity.until + clocks_differ};
    const Authority identity = make_authority_of(id, "identities", authorities);
    const Authority permitting = make_authority_of(id, "permissions", authorities);
    const KeyHandle own_key = make_key();
    const auto certify = [&](EVP_PKEY* key, const char* whose) {
      return issue(key, fmt::format("{}-{}", whose, id), identity.certificate.get(), identity.key.get(), validity);
    };
    const auto permit = [&](Side side, X509* holder) {
      return sign(permissions(side, subject_of(holder), partition, validity), permitting.certificate.get(),
                  permitting.key.get());
    };
    const CertificateHandle parents = certify(parents_key->get(), "parent");
    const CertificateHandle own = certify(own_key.get(), "wearer");
    const Json common = {{"version", 1},
                         {"id", id},
                         {"identity_ca", pem_of(identity.certificate.get())},
                         {"permissions_ca", pem_of(permitting.certificate.get())},
                         {"governance", sign(governance(), permitting.certificate.get(), permitting.key.get())}};

    Json own_texts = common;
    own_texts["certificate"] = pem_of(own.get());
    own_texts["permissions"] = permit(Side::passive, own.get());
    Pair pair{id,
              parents_name,
              side_,
              partition,
              validity.until,
              phrase(identity.certificate.get(), permitting.certificate.get(), parents_key->get(), own_key.get()),
              files_in(folder_ / id)};
    keep(pair, own_texts, pem_of(own_key.get()));

    Json theirs = common;
    theirs["name"] = name;
    theirs["certificate"] = pem_of(parents.get());
    theirs["permissions"] = permit(Side::active, parents.get());
    theirs["wearers_certificate"] = pem_of(own.get());
    return Granted{std::move(pair), armour("grant", theirs)};
  } catch (const std::exception& problem) {
    return Error{problem.what()};
  }
}

Result<Pair> PairStore::accept(const std::string& grant, WallTime now) {
  if (side_ != Side::active)
    return Error{"this is the wearer's PC: a grant is accepted on the parent's (`telehug pair finish`)"};
  const auto granted = unarmour("grant", grant);
  if (!granted) return granted.error();
  const std::string id = text_in(*granted, "id");
  const std::string name = text_in(*granted, "name");
  if (!is_id(id)) return Error{"the grant is refused: it names no pair"};
  if (!is_name(name)) return bad_name("the name in the grant");
  std::error_code none;
  if (fs::exists(folder_ / id, none)) return Error{fmt::format("the pair {} is known already", id)};
  try {
    std::string key_pem = read_secret(folder_ / "pending.key");
    const KeyHandle key = read_key(key_pem);
    if (!key) return Error{"no request was made on this PC: begin with `telehug pair request`"};
    const auto identity_ca = read_certificate(text_in(*granted, "identity_ca"));
    const auto permissions_ca = read_certificate(text_in(*granted, "permissions_ca"));
    const auto wearers = read_certificate(text_in(*granted, "wearers_certificate"));
    if (!identity_ca || !permissions_ca || !wearers)
      return Error{"the grant is refused: a certificate in it is damaged; ask for it again"};
    if (!issued_by(wearers.get(), identity_ca.get()))
      return Error{"the grant is refused: the wearer's certificate is of another authority"};
    const auto certificate = read_certificate(text_in(*granted, "certificate"));
    if (!certificate || !belongs_to(certificate.get(), key.get()))
      return Error{"the grant is refused: it answers another request than the last one of this PC"};
    Pair pair{id,
              name,
              side_,
              partition_of(id),
              validity_of(certificate.get()).until,
              phrase(identity_ca.get(), permissions_ca.get(), key.get(), X509_get0_pubkey(wearers.get())),
              files_in(folder_ / id)};
    // The one certificate of each authority that the phrase is made from, and no other that stood behind it in the
    // text: Fast DDS would trust every one of a file.
    Json texts = *granted;
    texts["identity_ca"] = pem_of(identity_ca.get());
    texts["permissions_ca"] = pem_of(permissions_ca.get());
    texts["certificate"] = pem_of(certificate.get());
    keep(pair, texts, key_pem);
    OPENSSL_cleanse(key_pem.data(), key_pem.size());
    // What the library will look at is looked at now, when it can still be said.
    if (const auto faults = preflight(pair, now); !faults.empty()) {
      revoke(id);
      return Error{"the grant is refused: " + faults.front().what};
    }
    wipe(folder_ / "pending.key");
    return pair;
  } catch (const std::exception& problem) {
    return Error{problem.what()};
  }
}

std::vector<Pair> PairStore::list() const {
  std::vector<Pair> pairs;
  if (!fs::exists(folder_)) return pairs;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (!is_id(entry.path().filename().string())) continue;
    if (auto pair = read_pair(entry.path(), side_)) pairs.push_back(*std::move(pair));
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.id < b.id; });
  return pairs;
}

bool PairStore::revoke(const std::string& id) {
  std::error_code none;
  if (!is_id(id) || !fs::is_directory(folder_ / id, none)) return false;
  // The key first: a running daemon follows it.
  wipe(files_in(folder_ / id).private_key);
  fs::remove_all(folder_ / id);
  return true;
}

}  // namespace telehug
