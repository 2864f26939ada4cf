// SPDX-License-Identifier: Apache-2.0
//
// The renewal of a pair: what the wearer's PC signs anew and what the parent's PC takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>

#include "doubles/temporary_folder.hpp"
#include "pairing/armour.hpp"
#include "pairing/certificates.hpp"
#include "pairing/pair_files.hpp"
#include "pairing/pairing.hpp"
#include "pairing/renewal_offer.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr auto day = std::chrono::hours(24);
const WallTime paired{std::chrono::seconds(1'800'000'000)};  // 2027-01-15
const WallTime end = paired + 365 * day;
const WallTime later = paired + 320 * day;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void overwrite(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

WallTime end_of(const std::string& certificate) {
  return validity_of(read_certificate(certificate).get()).until;
}

class RenewedPair : public testing::Test {
 protected:
  struct Ends {
    Pair parent;
    Pair wearer;
  };
  static Ends pair_up(PairStore& parent, PairStore& wearer) {
    const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", paired).value();
    return {parent.accept(granted.grant, paired).value(), granted.pair};
  }
  [[nodiscard]] Pair here() const { return parent.find(pair.parent.id).value(); }
  [[nodiscard]] Pair there() const { return wearer.find(pair.wearer.id).value(); }

  TemporaryFolder folder;
  PairStore parent{folder / "parent", Side::active};
  PairStore wearer{folder / "wearer", Side::passive};
  Ends pair = pair_up(parent, wearer);
};

TEST_F(RenewedPair, IsValidForAYearFromThenOnAtBothEnds) {
  const std::string old_certificate = content(pair.parent.files.certificate);
  const Renewal renewal = wearer.renew(there(), later).value();
  const auto installed = parent.install(renewal, later).value();
  ASSERT_TRUE(installed);
  EXPECT_EQ(installed->expires, later + 365 * day);
  EXPECT_EQ(here().expires, later + 365 * day);
  EXPECT_EQ(there().expires, later + 365 * day);
  EXPECT_NE(content(pair.parent.files.certificate), old_certificate);
  for (const WallTime when : {later, end + day}) {
    EXPECT_TRUE(parent.preflight(here(), when).empty());
    EXPECT_TRUE(wearer.preflight(there(), when).empty());
  }
}

TEST_F(RenewedPair, KeepsItsKeysNamesAuthoritiesAndPhrase) {
  const std::string subject = subject_of(read_certificate(content(pair.parent.files.certificate)).get());
  const std::string key = content(pair.parent.files.private_key);
  ASSERT_TRUE(parent.install(wearer.renew(there(), later).value(), later).value());
  EXPECT_EQ(subject_of(read_certificate(content(pair.parent.files.certificate)).get()), subject);
  EXPECT_EQ(content(pair.parent.files.private_key), key);
  EXPECT_EQ(here().phrase, there().phrase);
  EXPECT_EQ(here().name, "Mia");
  EXPECT_EQ(there().name, "Grandma");
}

TEST_F(RenewedPair, CanBeRenewedForTwentyYearsAndNoLonger) {
  const WallTime authorities_end = paired + 20 * 365 * day;
  for (WallTime now = paired + 300 * day; there().expires < authorities_end; now += 300 * day) {
    ASSERT_LT(now, authorities_end);
    const auto renewal = wearer.renew(there(), now);
    ASSERT_TRUE(renewal) << renewal.error().message;
    ASSERT_TRUE(parent.install(*renewal, now).value());
    ASSERT_TRUE(parent.preflight(here(), now).empty());
  }
  EXPECT_THAT(wearer.renew(there(), authorities_end - day).error().message, HasSubstr("pair the two PCs again"));
}

TEST_F(RenewedPair, TakesARenewalOnceAndAnOlderOneNotAtAll) {
  const Renewal first = wearer.renew(there(), later).value();
  const Renewal second = wearer.renew(there(), later + day).value();
  ASSERT_TRUE(parent.install(second, later + day).value());
  EXPECT_FALSE(parent.install(second, later + day).value());
  EXPECT_FALSE(parent.install(first, later + day).value());
  EXPECT_EQ(here().expires, later + 366 * day);
}

TEST_F(RenewedPair, ComesBackAfterItHasExpired) {
  const WallTime after = end + 100 * day;
  const auto expired = wearer.preflight(there(), after);
  ASSERT_EQ(expired.size(), 1U);
  EXPECT_THAT(expired.front().to_do, HasSubstr("telehug pair renew " + pair.wearer.id));
  ASSERT_TRUE(parent.install(wearer.renew(there(), after).value(), after).value());
  EXPECT_TRUE(parent.preflight(here(), after).empty());
  EXPECT_TRUE(wearer.preflight(there(), after).empty());
}

TEST_F(RenewedPair, SurvivesAChatWindow) {
  const std::string text = "Mia:\n> " + to_text(wearer.renew(there(), later).value()) + "\nBye!";
  EXPECT_TRUE(is_renewal(text));
  EXPECT_FALSE(is_renewal(parent.request("Grandma").value()));
  EXPECT_TRUE(parent.install(parse_renewal(text).value(), later).value());
  EXPECT_THAT(parse_renewal(text.substr(0, 400)).error().message, HasSubstr("no telehug renewal"));
}

TEST_F(RenewedPair, NeverSendsAKeyAndKeepsItsSecretsToTheirOwner) {
  const Renewal renewal = wearer.renew(there(), later).value();
  EXPECT_THAT(renewal.certificate + renewal.permissions, Not(HasSubstr("PRIVATE")));
  for (const auto& file : fs::recursive_directory_iterator(folder / "wearer")) {
    struct stat about {};
    ASSERT_EQ(stat(file.path().c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777U, file.is_directory() ? 0700U : 0600U) << file.path();
  }
  const fs::path key = renewal_files_in(folder_of(there())).identity_key;
  ASSERT_EQ(chmod(key.c_str(), 0640), 0);
  EXPECT_EQ(wearer.preflight(there(), later).at(0).to_do, "chmod 600 " + key.string());
}

TEST_F(RenewedPair, ThatIsRevokedLeavesNoAuthorityBehind) {
  const RenewalFiles files = renewal_files_in(folder_of(there()));
  fs::create_hard_link(files.identity_key, folder / "identity");
  fs::create_hard_link(files.permissions_key, folder / "permissions");
  ASSERT_THAT(content(folder / "identity"), HasSubstr("KEY"));
  EXPECT_TRUE(wearer.revoke(pair.wearer.id));
  EXPECT_THAT(content(folder / "identity"), Not(HasSubstr("KEY")));
  EXPECT_THAT(content(folder / "permissions"), Not(HasSubstr("KEY")));
  EXPECT_FALSE(wearer.renew(pair.wearer, later));
}

// Whatever stands on the disk after a crash between two files.
TEST_F(RenewedPair, IsUsableInAnyMixtureOfOldAndNewFiles) {
  for (const bool parents : {true, false}) {
    const Ends ends = pair_up(parent, wearer);
    const Pair& old = parents ? ends.parent : ends.wearer;
    const fs::path about = folder_of(old) / "pair.json";
    const std::vector<fs::path> files = {old.files.certificate, old.files.permissions, about};
    std::vector<std::string> before;
    for (const fs::path& file : files)
      before.push_back(content(file));
    const Renewal renewal = wearer.renew(ends.wearer, later).value();
    ASSERT_TRUE(!parents || parent.install(renewal, later).value());
    std::vector<std::string> after;
    for (const fs::path& file : files)
      after.push_back(content(file));
    for (unsigned mixture = 0; mixture < 8; ++mixture) {
      for (unsigned i = 0; i < 3; ++i)
        overwrite(files[i], (mixture >> i & 1U) != 0 ? after[i] : before[i]);
      const PairStore& store = parents ? parent : wearer;
      const Pair mixed = store.find(old.id).value();
      EXPECT_EQ(mixed.expires, mixture == 7 ? later + 365 * day : end) << mixture;
      EXPECT_TRUE(store.preflight(mixed, end - day).empty()) << mixture;
      // The certificate's end and that of the permissions are both looked at.
      EXPECT_EQ(store.preflight(mixed, end).empty(), (mixture & 3U) == 3) << mixture;
      // What broke off is made good by the next one.
      EXPECT_TRUE(!parents || parent.install(renewal, later).value().has_value() == (mixture != 7)) << mixture;
    }
  }
}

TEST_F(RenewedPair, IsLeftAsItWasByARenewalThatIsNotItsOwn) {
  PairStore father(folder / "father", Side::active);
  PairStore stranger(folder / "stranger", Side::passive);
  const Ends fathers = pair_up(father, wearer);
  PairStore other(folder / "other", Side::active);
  const Ends others = pair_up(other, stranger);
  const Renewal own = wearer.renew(there(), later).value();
  const Renewal of_father = wearer.renew(fathers.wearer, later).value();
  const auto refusal = [&](const Renewal& renewal) { return parent.install(renewal, later).error().message; };

  EXPECT_THAT(refusal(of_father), HasSubstr("none of this PC"));
  EXPECT_THAT(refusal({"../wearer", own.certificate, own.permissions}), HasSubstr("none of this PC"));
  EXPECT_THAT(refusal({own.pair, "nonsense", own.permissions}), HasSubstr("damaged"));
  EXPECT_THAT(refusal({own.pair, of_father.certificate, own.permissions}), HasSubstr("identity authority"));
  EXPECT_THAT(refusal({own.pair, stranger.renew(others.wearer, later)->certificate, own.permissions}),
              HasSubstr("identity authority"));
  EXPECT_THAT(refusal({own.pair, content(there().files.certificate), own.permissions}), HasSubstr("another key"));
  EXPECT_THAT(refusal({own.pair, own.certificate, of_father.permissions}), HasSubstr("not signed by"));
  EXPECT_THAT(refusal({own.pair, own.certificate, content(there().files.permissions)}), HasSubstr("does not permit"));
  EXPECT_THAT(refusal({own.pair, own.certificate, content(pair.parent.files.permissions)}),
              HasSubstr("does not permit"));
  EXPECT_THAT(parent.install(own, later + 366 * day).error().message, HasSubstr("expired"));
  EXPECT_THAT(parent.install(own, paired - 2 * day).error().message, HasSubstr("clocks"));
  EXPECT_EQ(here().expires, end);
  EXPECT_TRUE(parent.preflight(here(), paired).empty());
  EXPECT_TRUE(parent.install(own, later).value());
}

TEST_F(RenewedPair, TrustsNoCertificateThatStandsBehindItsOwn) {
  Renewal renewal = wearer.renew(there(), later).value();
  const std::string own = renewal.certificate;
  renewal.certificate += content(there().files.identity_ca);
  ASSERT_TRUE(parent.install(renewal, later).value());
  EXPECT_EQ(content(here().files.certificate), own);
}

// The authority gave somebody else's name to this key: only its own is taken.
TEST_F(RenewedPair, KeepsToItsOwnName) {
  const RenewalFiles files = renewal_files_in(folder_of(there()));
  const auto authority = read_certificate(content(there().files.identity_ca));
  const auto key = read_key(content(files.identity_key));
  const auto parents_key = read_key(content(here().files.private_key));
  Renewal renewal = wearer.renew(there(), later).value();
  renewal.certificate =
      pem_of(issue(parents_key.get(), "wearer-" + renewal.pair, authority.get(), key.get(), {paired, later + 365 * day})
                 .get());
  EXPECT_THAT(parent.install(renewal, later).error().message, HasSubstr("CN=wearer-"));
}

TEST_F(RenewedPair, IsRenewedByTheWearersPcAlone) {
  EXPECT_THAT(parent.renew(here(), later).error().message, HasSubstr("on the wearer's"));
  EXPECT_THAT(wearer.install(wearer.renew(there(), later).value(), later).error().message,
              HasSubstr("the wearer's PC"));
}

// As a telehug left it that forgot its authorities' keys.
TEST_F(RenewedPair, CantBeOneWhoseAuthoritiesWereForgotten) {
  const RenewalFiles files = renewal_files_in(folder_of(there()));
  for (const fs::path& file : {files.identity_key, files.permissions_key, files.parents_certificate}) {
    const std::string before = content(file);
    fs::remove(file);
    EXPECT_THAT(wearer.renew(there(), later).error().message, HasSubstr("pair the two PCs again")) << file;
    overwrite(file, before);
  }
  EXPECT_EQ(there().expires, end);
}

TEST_F(RenewedPair, IsNotShortenedByAClockThatIsBehind) {
  EXPECT_THAT(wearer.renew(there(), paired - 10 * day).error().message, HasSubstr("check this PC's clock"));
  EXPECT_EQ(there().expires, end);
}

TEST_F(RenewedPair, HoldsWhenAClockThatWasAheadIsRightAgain) {
  ASSERT_TRUE(wearer.renew(there(), later));
  EXPECT_TRUE(wearer.preflight(there(), paired).empty());
}

class TheOffer : public RenewedPair {
 protected:
  RenewalOffer offer{pair.wearer};
};

TEST_F(TheOffer, IsMadeOnceSixtyDaysBeforeTheEnd) {
  ASSERT_TRUE(offer.serve(end - 60 * day - std::chrono::seconds(20)));
  EXPECT_FALSE(offer.newest());
  EXPECT_EQ(there().expires, end);
  const WallTime due = end - 60 * day;
  ASSERT_TRUE(offer.serve(due));
  ASSERT_TRUE(offer.newest());
  EXPECT_EQ(there().expires, due + 365 * day);
  const std::string certificate = offer.newest()->certificate;
  EXPECT_EQ(end_of(certificate), due + 365 * day);
  ASSERT_TRUE(offer.serve(due + 304 * day));
  EXPECT_EQ(offer.newest()->certificate, certificate);
  ASSERT_TRUE(offer.serve(due + 306 * day));
  EXPECT_NE(offer.newest()->certificate, certificate);
}

TEST_F(TheOffer, IsThereAgainAfterARestart) {
  ASSERT_TRUE(offer.serve(later));
  RenewalOffer next(pair.wearer);
  ASSERT_TRUE(next.serve(later + day));
  ASSERT_TRUE(next.newest());
  EXPECT_EQ(next.newest()->certificate, offer.newest()->certificate);
  EXPECT_TRUE(parent.install(*next.newest(), later + day).value());
}

TEST_F(TheOffer, FollowsARenewalByHandWithinTenSeconds) {
  ASSERT_TRUE(offer.serve(paired));
  EXPECT_FALSE(offer.newest());
  const Renewal by_hand = wearer.renew(there(), paired + day).value();
  ASSERT_TRUE(offer.serve(paired + std::chrono::seconds(10)));
  ASSERT_TRUE(offer.newest());
  EXPECT_EQ(offer.newest()->certificate, by_hand.certificate);
}

// Of the two sides' ends the first counts: here the wearer's own files alone were renewed.
TEST_F(TheOffer, IsMadeAgainWhenItBrokeOffInBetween) {
  const Renewal renewal = wearer.renew(there(), later).value();
  fs::remove(renewal_files_in(folder_of(there())).newest);
  ASSERT_TRUE(offer.serve(later));
  ASSERT_TRUE(offer.newest());
  EXPECT_NE(offer.newest()->certificate, renewal.certificate);
}

TEST_F(TheOffer, IsMadeAgainWhenItBrokeOffBeforeTheWearersOwnFiles) {
  const std::string certificate = content(pair.wearer.files.certificate);
  const std::string permissions = content(pair.wearer.files.permissions);
  const Renewal renewal = wearer.renew(there(), later).value();
  overwrite(pair.wearer.files.certificate, certificate);
  overwrite(pair.wearer.files.permissions, permissions);
  ASSERT_EQ(there().expires, end);
  // What was made for the parent's PC is good all the same.
  EXPECT_TRUE(parent.install(renewal, later).value());
  ASSERT_TRUE(offer.serve(later + day));
  EXPECT_EQ(there().expires, later + 366 * day);
  EXPECT_TRUE(parent.install(offer.newest().value(), later + day).value());
}

TEST_F(TheOffer, SaysOnceAnHourThatItCantBeMade) {
  fs::remove(renewal_files_in(folder_of(there())).identity_key);
  EXPECT_THAT(offer.serve(later).error().message, HasSubstr("pair the two PCs again"));
  EXPECT_TRUE(offer.serve(later + std::chrono::minutes(30)));
  EXPECT_FALSE(offer.serve(later + std::chrono::minutes(61)));
}

TEST_F(TheOffer, OfARevokedPairIsNone) {
  wearer.revoke(pair.wearer.id);
  EXPECT_TRUE(offer.serve(later));
  EXPECT_FALSE(offer.newest());
}

}  // namespace
}  // namespace telehug
