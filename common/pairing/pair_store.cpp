// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <openssl/crypto.h>

#include <algorithm>
#include <stdexcept>

#include "common/outside_json.hpp"
#include "common/printable.hpp"
#include "pairing/armour.hpp"
#include "pairing/authority.hpp"
#include "pairing/pair_files.hpp"
#include "pairing/pairing.hpp"
#include "pairing/phrase.hpp"
#include "pairing/secret_files.hpp"
#include "pairing/wireguard.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr auto authorities_live = std::chrono::hours(24 * 365 * 20);
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

// What both PCs know and whoever sat between them would have had to replace. `tunnel`: the public keys of its ends.
std::string phrase(X509* identity_ca, X509* permissions_ca, EVP_PKEY* parent, EVP_PKEY* wearer,
                   const std::string& tunnel) {
  return phrase_of(der_of(identity_ca) + der_of(permissions_ca) + public_der_of(parent) + public_der_of(wearer) +
                   tunnel);
}

std::string agreed_tunnel(const TunnelOffer& parent, const TunnelOffer& wearer) {
  return parent.public_key + wearer.public_key;
}

void keep_tunnel(const fs::path& folder, Side side, const TunnelEnd& own, const TunnelOffer& other) {
  make_secret_folder(folder);
  std::string conf = wireguard_conf(folder.filename().string(), side, own, other);
  write_secret(wireguard_file_in(folder), conf);
  OPENSSL_cleanse(conf.data(), conf.size());
}

void keep_key(const fs::path& file, EVP_PKEY* key) {
  std::string pem = pem_of(key);
  write_secret(file, pem);
  OPENSSL_cleanse(pem.data(), pem.size());
}

void keep_authorities(const fs::path& folder, const Authority& identity, const Authority& permitting,
                      const std::string& parents_certificate) {
  make_secret_folder(folder);
  const RenewalFiles files = renewal_files_in(folder);
  keep_key(files.identity_key, identity.key.get());
  keep_key(files.permissions_key, permitting.key.get());
  write_secret(files.parents_certificate, parents_certificate);
}

// The pair's folder appears whole or not at all. pair.json comes last: without it there is no pair.
void keep(const Pair& pair, const Json& texts, std::string key_pem) {
  const fs::path folder = folder_of(pair);
  make_secret_folder(folder.parent_path());
  make_secret_folder(folder);
  write_secret(pair.files.private_key, key_pem);
  OPENSSL_cleanse(key_pem.data(), key_pem.size());
  write_secret(pair.files.identity_ca, text_in(texts, "identity_ca"));
  write_secret(pair.files.certificate, text_in(texts, "certificate"));
  write_secret(pair.files.permissions_ca, text_in(texts, "permissions_ca"));
  write_secret(pair.files.governance, text_in(texts, "governance"));
  write_secret(pair.files.permissions, text_in(texts, "permissions"));
  keep_about(pair);
}

}  // namespace

PairStore::PairStore(fs::path folder, Side side) : folder_(std::move(folder)), side_(side) {
  std::error_code problem;
  if (fs::exists(folder_, problem) && !fs::is_directory(folder_, problem))
    throw std::runtime_error(fmt::format("{} is no folder: pairs can't be kept there", folder_.string()));
}

Result<std::string> PairStore::request(const std::string& name, const std::string& reachable_at) {
  if (side_ != Side::active)
    return Error{"this is the wearer's PC: the request is made on the parent's (`telehug pair request`)"};
  if (!is_name(name)) return bad_name("the name");
  try {
    const KeyHandle key = make_key();
    make_secret_folder(folder_);
    keep_key(folder_ / "pending.key", key.get());
    // Offered to every wearer, whose PC may be the one that can be dialled.
    const TunnelEnd tunnel = make_tunnel_end(reachable_at);
    write_secret(folder_ / "pending.wireguard", to_text(tunnel));
    return armour("request", {{"version", 1},
                              {"name", name},
                              {"request", signing_request(key.get(), "request")},
                              {"wireguard", to_json(tunnel.offer)}});
  } catch (const std::exception& problem) {
    return Error{problem.what()};
  }
}

Result<PairStore::Granted> PairStore::grant(const std::string& request, const std::string& name, WallTime now,
                                            const std::string& reachable_at) {
  if (side_ != Side::passive)
    return Error{"this is the parent's PC: what is felt is granted on the wearer's (`telehug pair grant`)"};
  if (!is_name(name)) return bad_name("the wearer's name");
  const auto asked = unarmour("request", request);
  if (!asked) return asked.error();
  const std::string parents_name = text_in(*asked, "name");
  if (!is_name(parents_name)) return bad_name("the name in the request");
  const auto parents_key = read_signing_request(text_in(*asked, "request"));
  if (!parents_key) return Error{"the request is refused: " + parents_key.error().message};
  const auto parents_offer = tunnel_offer_in(*asked);
  if (!parents_offer) return Error{"the request is refused: " + parents_offer.error().message};
  const bool has_offer = parents_offer->has_value();
  if (!reachable_at.empty() && !has_offer)
    return Error{
        "the request offers no WireGuard tunnel: the parent's telehug is older; update it, or leave "
        "--wireguard out"};
  const bool tunnelled = has_offer && !(reachable_at.empty() && (*parents_offer)->endpoint.empty());
  try {
    if (list().size() >= max_pairs)
      return Error{fmt::format("this PC has {} pairs already: revoke one (`telehug pair list`)", max_pairs)};
    make_secret_folder(folder_);
    const std::string id = random_hex(8);
    const std::string partition = partition_of(id);
    const Validity validity = members_validity(now);
    // They outlive many renewals.
    const Validity authorities{validity.from, now + authorities_live};
    const Authority identity = make_authority_of(id, "identities", authorities);
    const Authority permitting = make_authority_of(id, "permissions", authorities);
    const KeyHandle own_key = make_key();
    const auto member = [&](Side side, EVP_PKEY* key) { return admit(id, side, key, identity, permitting, validity); };
    const Member parents = member(Side::active, parents_key->get());
    const Member own = member(Side::passive, own_key.get());
    const Json common = {{"version", 1},
                         {"id", id},
                         {"identity_ca", pem_of(identity.certificate.get())},
                         {"permissions_ca", pem_of(permitting.certificate.get())},
                         {"governance", sign(governance(), permitting.certificate.get(), permitting.key.get())}};

    std::optional<TunnelEnd> tunnel;
    if (tunnelled) tunnel = make_tunnel_end(reachable_at);

    Json own_texts = common;
    own_texts["certificate"] = own.certificate;
    own_texts["permissions"] = own.permissions;
    Pair pair{id,
              parents_name,
              side_,
              partition,
              validity.until,
              phrase(identity.certificate.get(), permitting.certificate.get(), parents_key->get(), own_key.get(),
                     tunnel ? agreed_tunnel(**parents_offer, tunnel->offer) : ""),
              files_in(folder_ / id)};
    keep_authorities(folder_ / id, identity, permitting, parents.certificate);
    if (tunnel) keep_tunnel(folder_ / id, side_, *tunnel, **parents_offer);
    keep(pair, own_texts, pem_of(own_key.get()));

    Json theirs = common;
    theirs["name"] = name;
    theirs["certificate"] = parents.certificate;
    theirs["permissions"] = parents.permissions;
    theirs["wearers_certificate"] = own.certificate;
    if (tunnel) theirs["wireguard"] = to_json(tunnel->offer);
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
  const auto wearers_offer = tunnel_offer_in(*granted);
  if (!wearers_offer) return Error{"the grant is refused: " + wearers_offer.error().message};
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
    const auto tunnel =
        *wearers_offer ? read_tunnel_end(read_secret(folder_ / "pending.wireguard")) : std::optional<TunnelEnd>();
    if (*wearers_offer && !tunnel)
      return Error{"the grant is refused: it tells of a tunnel that this PC did not offer; make a new request"};
    Pair pair{id,
              name,
              side_,
              partition_of(id),
              validity_of(certificate.get()).until,
              phrase(identity_ca.get(), permissions_ca.get(), key.get(), X509_get0_pubkey(wearers.get()),
                     tunnel ? agreed_tunnel(tunnel->offer, **wearers_offer) : ""),
              files_in(folder_ / id)};
    // The one certificate of each authority that the phrase is made from, and no other that stood behind it in the
    // text: Fast DDS would trust every one of a file.
    Json texts = *granted;
    texts["identity_ca"] = pem_of(identity_ca.get());
    texts["permissions_ca"] = pem_of(permissions_ca.get());
    texts["certificate"] = pem_of(certificate.get());
    if (tunnel) keep_tunnel(folder_ / id, side_, *tunnel, **wearers_offer);
    keep(pair, texts, key_pem);
    OPENSSL_cleanse(key_pem.data(), key_pem.size());
    // What the library will look at is looked at now, when it can still be said.
    if (const auto faults = preflight(pair, now); !faults.empty()) {
      revoke(id);
      return Error{"the grant is refused: " + faults.front().what};
    }
    wipe(folder_ / "pending.key");
    wipe(folder_ / "pending.wireguard");
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

std::optional<Pair> PairStore::find(const std::string& id) const {
  return is_id(id) ? read_pair(folder_ / id, side_) : std::nullopt;
}

bool PairStore::revoke(const std::string& id) {
  std::error_code none;
  if (!is_id(id) || !fs::is_directory(folder_ / id, none)) return false;
  // The key first: a running daemon follows it.
  wipe(files_in(folder_ / id).private_key);
  wipe(renewal_files_in(folder_ / id).identity_key);
  wipe(renewal_files_in(folder_ / id).permissions_key);
  wipe(wireguard_file_in(folder_ / id));
  fs::remove_all(folder_ / id);
  return true;
}

}  // namespace telehug
