// SPDX-License-Identifier: Apache-2.0
//
// The files of a pair that somebody or a bad disk changed, one at a time, and what a daemon makes of them at its start.
// Where it finds no fault, what OpenSSL and Fast DDS go by must be as it was made.
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "daemon/membership.hpp"
#include "doubles/temporary_folder.hpp"
#include "fuzz/bytes.hpp"
#include "fuzz/edits.hpp"
#include "pairing/certificates.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;

const WallTime now{std::chrono::seconds(1'800'000'000)};
constexpr std::size_t most_edits = 6;

void require(bool holds) {
  if (!holds) std::abort();
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void overwrite(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

// Is `certificate` of the authority, as OpenSSL and with it Fast DDS judge it?
bool verifies(X509* certificate, X509* authority) {
  const std::unique_ptr<X509_STORE, FreedBy<X509_STORE_free>> store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), authority);
  const std::unique_ptr<X509_STORE_CTX, FreedBy<X509_STORE_CTX_free>> context(X509_STORE_CTX_new());
  X509_STORE_CTX_init(context.get(), store.get(), certificate, nullptr);
  X509_STORE_CTX_set_time(context.get(), 0, now.time_since_epoch().count());
  return X509_verify_cert(context.get()) == 1;
}

// One side's pair.
class Home {
 public:
  Home(fs::path folder, Side side, Pair pair) : folder_(std::move(folder)), side_(side), pair_(std::move(pair)) {
    const DdsSecurityFiles& files = pair_.files;
    files_ = {files.identity_ca,
              files.certificate,
              files.private_key,
              files.permissions_ca,
              files.governance,
              files.permissions,
              files.private_key.parent_path() / "pair.json"};
    for (const fs::path& file : files_)
      originals_.push_back(content(file));
  }

  void change(Bytes& bytes) const {
    const std::size_t which = bytes.byte() % files_.size();
    const std::string& original = originals_[which];
    std::string text;
    switch (bytes.byte() % 4) {
      case 0:
        text = bytes.rest();
        break;
      case 1:
        text = edited(original, bytes, most_edits);
        break;
      case 2:
        text = edited_within_base64(original, bytes, most_edits);
        break;
      default:
        text = originals_[bytes.byte() % originals_.size()] + (bytes.byte() % 2 == 0 ? original : "");
        break;
    }
    overwrite(files_[which], text);
    start();
    overwrite(files_[which], original);
  }

 private:
  void start() const {
    PeerConfig config;
    config.pairs_folder = folder_.string();
    const auto all = memberships(config, side_, now);
    if (!all) return require(!all.error().message.empty());
    if (all->members.empty()) return require(!why_none(*all).empty());
    const Membership& member = all->members.front();
    if (!member.pair) return;  // pair.json is no more
    (void)describe(member);
    (void)pair_json(*member.pair);
    (void)pair_over(member, now);
    const Pair& found = *member.pair;
    require(found.id == pair_.id && found.partition == pair_.partition && found.expires <= pair_.expires);
    const auto certificate = read_certificate(content(found.files.certificate));
    const auto identity_ca = read_certificate(content(found.files.identity_ca));
    const auto permissions_ca = read_certificate(content(found.files.permissions_ca));
    require(content(found.files.certificate) == originals_[1]);
    require(verifies(certificate.get(), identity_ca.get()));
    require(same_key(identity_ca.get(), originals_[0]) && same_key(permissions_ca.get(), originals_[3]));
    require(belongs_to(certificate.get(), read_key(content(found.files.private_key)).get()));
    for (const auto& [file, original] :
         {std::pair(found.files.governance, originals_[4]), std::pair(found.files.permissions, originals_[5])}) {
      const auto authority = read_certificate(originals_[3]);
      require(read_signed(content(file), authority.get()).value() == read_signed(original, authority.get()).value());
    }
  }

  static bool same_key(X509* certificate, const std::string& original) {
    return belongs_to(certificate, X509_get0_pubkey(read_certificate(original).get()));
  }

  fs::path folder_;
  Side side_;
  Pair pair_;
  std::array<fs::path, 7> files_;
  std::vector<std::string> originals_;
};

class TwoHomes {
 public:
  TwoHomes() {
    PairStore parent(folder_ / "parent", Side::active);
    PairStore wearer(folder_ / "wearer", Side::passive);
    const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", now).value();
    homes_.emplace_back(folder_ / "parent", Side::active, parent.accept(granted.grant, now).value());
    homes_.emplace_back(folder_ / "wearer", Side::passive, granted.pair);
  }
  [[nodiscard]] const Home& home(std::size_t which) const { return homes_[which]; }

 private:
  TemporaryFolder folder_;
  std::vector<Home> homes_;
};

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const telehug::TwoHomes homes;
  telehug::Bytes bytes(data, size);
  homes.home(bytes.byte() % 2).change(bytes);
  return 0;
}
