// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <limits>

#include "doubles/temporary_folder.hpp"
#include "pairing/armour.hpp"
#include "pairing/certificates.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const WallTime now{std::chrono::seconds(1'800'000'000)};  // 2027-01-15
constexpr auto day = std::chrono::hours(24);

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void overwrite(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

class Pairs : public testing::Test {
 protected:
  // Both ends of one pairing.
  struct Ends {
    Pair parent;
    Pair wearer;
  };
  static Ends pair_up(PairStore& parent, PairStore& wearer) {
    const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", now).value();
    return {parent.accept(granted.grant, now).value(), granted.pair};
  }

  // What preflight says of a pair of which one file was damaged.
  [[nodiscard]] static PairingFault only_fault(const PairStore& store, const Pair& pair, WallTime at = now) {
    const auto faults = store.preflight(pair, at);
    EXPECT_EQ(faults.size(), 1U);
    return faults.empty() ? PairingFault{} : faults.front();
  }

  TemporaryFolder folder;
  PairStore parent{folder / "parent", Side::active};
  PairStore wearer{folder / "wearer", Side::passive};
};

TEST_F(Pairs, AreTheSameOnBothPcs) {
  const auto [here, there] = pair_up(parent, wearer);
  EXPECT_EQ(here.id, there.id);
  EXPECT_EQ(here.phrase, there.phrase);
  EXPECT_EQ(here.partition, there.partition);
  EXPECT_EQ(here.expires, there.expires);
  EXPECT_EQ(here.name, "Mia");
  EXPECT_EQ(there.name, "Grandma");
  EXPECT_EQ(std::count(here.phrase.begin(), here.phrase.end(), ' '), 7);
}

TEST_F(Pairs, AreFaultlessAndListedAfterwards) {
  const auto [here, there] = pair_up(parent, wearer);
  EXPECT_TRUE(parent.preflight(here, now).empty());
  EXPECT_TRUE(wearer.preflight(there, now).empty());
  const auto listed = PairStore(folder / "parent", Side::active).list();
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_EQ(listed[0].id, here.id);
  EXPECT_EQ(listed[0].phrase, here.phrase);
  EXPECT_EQ(listed[0].expires, here.expires);
}

TEST_F(Pairs, OfOneWearerHaveIdsPartitionsAuthoritiesAndPhrasesOfTheirOwn) {
  PairStore father(folder / "father", Side::active);
  const auto first = pair_up(parent, wearer).wearer;
  const auto second = pair_up(father, wearer).wearer;
  EXPECT_NE(first.id, second.id);
  EXPECT_NE(first.partition, second.partition);
  EXPECT_NE(first.phrase, second.phrase);
  EXPECT_NE(content(first.files.identity_ca), content(second.files.identity_ca));
  EXPECT_NE(content(first.files.permissions_ca), content(second.files.permissions_ca));
}

// Somebody in between asks the wearer's PC with a key of their own, and answers the parent's PC from a wearer's PC of
// their own: both pairs work, but the words are not the same.
TEST_F(Pairs, ThatSomebodySitsBetweenHaveDifferentPhrases) {
  PairStore false_parent(folder / "false-parent", Side::active);
  PairStore false_wearer(folder / "false-wearer", Side::passive);
  EXPECT_NE(pair_up(parent, false_wearer).parent.phrase, pair_up(false_parent, wearer).wearer.phrase);
}

TEST_F(Pairs, KeepTheirSecretsToTheirOwner) {
  const auto [here, there] = pair_up(parent, wearer);
  for (const auto& file : fs::recursive_directory_iterator(folder / "wearer")) {
    struct stat about {};
    ASSERT_EQ(stat(file.path().c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777U, file.is_directory() ? 0700U : 0600U) << file.path();
  }
}

TEST_F(Pairs, NeverSendAPrivateKey) {
  const std::string request = parent.request("Grandma").value();
  const auto granted = wearer.grant(request, "Mia", now).value();
  // The texts hold JSON in Base64, which holds PEM: "PRIVATE KEY" would be in one of three forms.
  for (const char* form : {"UFJJVkFURSBLRV", "BSSVZBVEUgS0VZ", "QUklWQVRFIEtFW"}) {
    EXPECT_THAT(request, Not(HasSubstr(form)));
    EXPECT_THAT(granted.grant, Not(HasSubstr(form)));
  }
}

TEST_F(Pairs, SurviveAChatWindow) {
  std::string request = "Here it is:\n> " + parent.request("Grandma").value() + "\nBye!";
  for (std::size_t at = request.find('\n', 60); at != std::string::npos; at = request.find('\n', at + 6))
    request.replace(at, 1, " \r\n > ");
  const auto granted = wearer.grant(request, "Mia", now);
  ASSERT_TRUE(granted) << granted.error().message;
}

TEST_F(Pairs, RefuseTextsThatAreDamagedOrAreSomethingElse) {
  const std::string request = parent.request("Grandma").value();
  for (std::size_t length = 0; length + 2 < request.size(); length += 37)
    EXPECT_FALSE(wearer.grant(request.substr(0, length), "Mia", now));
  for (std::size_t at = 40; at < request.size() - 40; at += 23) {
    std::string changed = request;
    changed[at] = changed[at] == 'A' ? 'B' : 'A';
    const auto granted = wearer.grant(changed, "Mia", now);
    // A changed name is a name, and a changed offer of a tunnel that nobody wants is nothing; a changed key or
    // signature is refused.
    EXPECT_TRUE(!granted || granted->pair.name != "Grandma" ||
                unarmour("request", changed).value()["request"] == unarmour("request", request).value()["request"])
        << at;
  }
  EXPECT_THAT(wearer.grant(std::string(100'000, 'A'), "Mia", now).error().message, HasSubstr("too long"));
  EXPECT_FALSE(wearer.grant("", "Mia", now));
}

// A JSON value is copied recursively.
TEST_F(Pairs, RefuseTextsThatAreNestedDeeply) {
  const std::string brackets = std::string(20'000, '[') + std::string(20'000, ']');
  // Its dump is recursive, too: so the text is put together by hand.
  const std::string json = "{\"version\":" + brackets + "}";
  std::vector<unsigned char> base64(4 * ((json.size() + 2) / 3) + 1);
  EVP_EncodeBlock(base64.data(), reinterpret_cast<const unsigned char*>(json.data()), static_cast<int>(json.size()));
  const std::string text = "-----BEGIN TELEHUG request-----" + std::string(base64.begin(), base64.end() - 1) +
                           "-----END TELEHUG request-----";
  EXPECT_THAT(unarmour("request", text).error().message, HasSubstr("damaged"));
}

TEST_F(Pairs, RefuseAGrantThatAnswersAnotherRequest) {
  const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", now).value();
  (void)parent.request("Grandma").value();
  EXPECT_THAT(parent.accept(granted.grant, now).error().message, HasSubstr("another request"));
  EXPECT_TRUE(parent.list().empty());
}

// Somebody on the way adds an authority of their own behind the wearer's: the phrase is the same, since it is made from
// the first one.
TEST_F(Pairs, TrustNoAuthorityThatStandsBehindTheWearersInTheGrant) {
  PairStore false_parent(folder / "false-parent", Side::active);
  PairStore false_wearer(folder / "false-wearer", Side::passive);
  const std::string false_authority = content(pair_up(false_parent, false_wearer).wearer.files.identity_ca);
  auto grant = unarmour("grant", wearer.grant(parent.request("Grandma").value(), "Mia", now)->grant).value();
  const std::string authority = grant["identity_ca"];
  grant["identity_ca"] = authority + false_authority;
  const Pair pair = parent.accept(armour("grant", grant), now).value();
  EXPECT_EQ(content(pair.files.identity_ca), authority);
  overwrite(pair.files.identity_ca, authority + false_authority);
  EXPECT_THAT(only_fault(parent, pair).what, HasSubstr("more than one certificate"));
}

TEST_F(Pairs, RefuseAGrantWhoseWearerIsOfAnotherAuthority) {
  PairStore false_parent(folder / "false-parent", Side::active);
  PairStore false_wearer(folder / "false-wearer", Side::passive);
  auto grant = unarmour("grant", wearer.grant(parent.request("Grandma").value(), "Mia", now)->grant).value();
  grant["wearers_certificate"] = content(pair_up(false_parent, false_wearer).wearer.files.certificate);
  EXPECT_THAT(parent.accept(armour("grant", grant), now).error().message, HasSubstr("of another authority"));
}

TEST_F(Pairs, RefuseARequestThatIsNotSignedWithItsOwnKey) {
  auto request = unarmour("request", parent.request("Grandma").value()).value();
  std::string signing_request = request["request"];
  // The signature stands last; 40 characters before the end are within it.
  char& letter = signing_request.at(signing_request.rfind("-----END") - 40);
  letter = letter == 'A' ? 'B' : 'A';
  request["request"] = signing_request;
  EXPECT_THAT(wearer.grant(armour("request", request), "Mia", now).error().message,
              HasSubstr("not signed with its own key"));
}

TEST_F(Pairs, RefuseARequestWithAKeyOfAnotherKind) {
  const KeyHandle key(EVP_EC_gen("P-384"));
  const nlohmann::json request = {{"version", 1}, {"name", "Grandma"}, {"request", signing_request(key.get(), "any")}};
  EXPECT_THAT(wearer.grant(armour("request", request), "Mia", now).error().message,
              HasSubstr("not an EC key on P-256"));
}

TEST_F(Pairs, AreAHundredAtMost) {
  const std::string request = parent.request("Grandma").value();
  for (int i = 0; i < 100; ++i)
    ASSERT_TRUE(wearer.grant(request, "Mia", now));
  EXPECT_THAT(wearer.grant(request, "Mia", now).error().message, HasSubstr("100 pairs already"));
}

TEST_F(Pairs, AreAcceptedOnce) {
  const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", now).value();
  ASSERT_TRUE(parent.accept(granted.grant, now));
  EXPECT_FALSE(parent.accept(granted.grant, now));
}

TEST_F(Pairs, AreMadeOnTheirOwnSideOnly) {
  EXPECT_FALSE(wearer.request("Mia"));
  EXPECT_FALSE(parent.grant(parent.request("Grandma").value(), "Mia", now));
  EXPECT_FALSE(wearer.accept("", now));
}

TEST_F(Pairs, HaveNamesThatCanBeShown) {
  EXPECT_FALSE(parent.request(""));
  EXPECT_FALSE(parent.request("Grand\nma"));
  EXPECT_FALSE(parent.request(std::string(65, 'a')));
  EXPECT_FALSE(parent.request("Grand\xC2\x85ma"));
  EXPECT_FALSE(parent.request("Gro\xDFmama"));  // ISO 8859, which JSON can't hold
  EXPECT_TRUE(parent.request("Großmama"));
  EXPECT_FALSE(wearer.grant(parent.request("Grandma").value(), "Zo\xEB", now));
  EXPECT_TRUE(wearer.list().empty());
}

TEST_F(Pairs, ThatAreRevokedLeaveNothingBehindAndCantBeUsedAgain) {
  const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", now).value();
  const Pair here = parent.accept(granted.grant, now).value();
  // A second name for the key's file shows what becomes of its bytes.
  fs::create_hard_link(here.files.private_key, folder / "seen");
  EXPECT_TRUE(parent.revoke(here.id));
  EXPECT_THAT(content(folder / "seen"), Not(HasSubstr("KEY")));
  EXPECT_TRUE(parent.list().empty());
  EXPECT_FALSE(fs::exists(folder / "parent" / here.id));
  EXPECT_FALSE(parent.revoke(here.id));
  EXPECT_FALSE(parent.accept(granted.grant, now));
}

TEST_F(Pairs, AreRevokedByTheirIdAndNothingElse) {
  pair_up(parent, wearer);
  fs::create_directory(folder / "wearer" / "else");
  EXPECT_FALSE(wearer.revoke("else"));
  EXPECT_FALSE(wearer.revoke(".."));
  EXPECT_FALSE(wearer.revoke("0123456789abcdef"));
  EXPECT_TRUE(fs::exists(folder / "wearer" / "else"));
  EXPECT_EQ(wearer.list().size(), 1U);
}

TEST_F(Pairs, ThatHaveExpiredOrAreNotYetValidAreNamed) {
  const Pair pair = pair_up(parent, wearer).parent;
  EXPECT_TRUE(parent.preflight(pair, pair.expires - std::chrono::seconds(1)).empty());
  const PairingFault over = only_fault(parent, pair, pair.expires);
  EXPECT_THAT(over.what, HasSubstr("expired on 2028-01-15"));
  EXPECT_EQ(over.file, pair.files.certificate);
  const auto early = parent.preflight(pair, now - 2 * day);
  ASSERT_FALSE(early.empty());
  EXPECT_THAT(early.front().to_do, HasSubstr("clock"));
}

TEST_F(Pairs, WhoseKeyOthersCanReadAreNamedWithWhatMendsIt) {
  const Pair pair = pair_up(parent, wearer).parent;
  ASSERT_EQ(chmod(pair.files.private_key.c_str(), 0644), 0);
  EXPECT_EQ(only_fault(parent, pair).to_do, "chmod 600 " + pair.files.private_key.string());
}

TEST_F(Pairs, WhoseFilesAreMissingOrDamagedAreNamedByTheFile) {
  const Pair pair = pair_up(parent, wearer).parent;
  for (const fs::path& file : {pair.files.certificate, pair.files.private_key, pair.files.governance,
                               pair.files.permissions, pair.files.permissions_ca, pair.files.identity_ca}) {
    const std::string whole = content(file);
    for (const std::string& damaged : {std::string(), std::string("nonsense"), whole.substr(0, whole.size() / 2)}) {
      overwrite(file, damaged);
      const PairingFault fault = only_fault(parent, pair);
      EXPECT_EQ(fault.file, file);
      EXPECT_FALSE(fault.to_do.empty());
    }
    overwrite(file, whole);
  }
  EXPECT_TRUE(parent.preflight(pair, now).empty());
}

TEST_F(Pairs, WhoseSignedDocumentsWereChangedAreNamed) {
  const Pair pair = pair_up(parent, wearer).parent;
  std::string document = content(pair.files.permissions);
  document.replace(document.find("passive/felt"), 12, "active/touch");
  overwrite(pair.files.permissions, document);
  const PairingFault fault = only_fault(parent, pair);
  EXPECT_EQ(fault.file, pair.files.permissions);
  EXPECT_THAT(fault.what, HasSubstr("changed afterwards"));
}

TEST_F(Pairs, EndNoLaterThanTheirCertificatesWhateverTheirFileSays) {
  const Pair pair = pair_up(parent, wearer).parent;
  const fs::path file = folder / "parent" / pair.id / "pair.json";
  auto about = nlohmann::json::parse(content(file));
  const std::int64_t end = about["expires"];
  about["expires"] = end + 1;
  overwrite(file, about.dump());
  EXPECT_EQ(parent.list().at(0).expires, pair.expires);
  about["expires"] = end - 1;
  overwrite(file, about.dump());
  EXPECT_EQ(parent.list().at(0).expires, pair.expires - std::chrono::seconds(1));
  // What no calendar knows can't even be shown.
  for (const nlohmann::json& impossible :
       {nlohmann::json(-1), nlohmann::json(std::numeric_limits<std::int64_t>::max()), nlohmann::json("2027")}) {
    about["expires"] = impossible;
    overwrite(file, about.dump());
    EXPECT_THROW((void)parent.list(), std::runtime_error) << impossible;
  }
}

// They hold the keys that are trusted; nobody but themselves signs them.
TEST_F(Pairs, WhoseAuthoritiesWereChangedAreNamed) {
  const Pair pair = pair_up(parent, wearer).parent;
  for (const fs::path& file : {pair.files.identity_ca, pair.files.permissions_ca}) {
    const std::string whole = content(file);
    // The signature stands last; 40 characters before the end are within it.
    std::string changed = whole;
    char& letter = changed.at(changed.rfind("-----END") - 40);
    letter = letter == 'A' ? 'B' : 'A';
    overwrite(file, changed);
    EXPECT_FALSE(parent.preflight(pair, now).empty()) << file;
    overwrite(file, whole);
  }
}

// A daemon would otherwise go on as if there were no pair.
TEST_F(Pairs, ThatCantBeReadAreNotTakenForNone) {
  const Pair pair = pair_up(parent, wearer).parent;
  const fs::path file = folder / "parent" / pair.id / "pair.json";
  overwrite(file, "nonsense");
  try {
    (void)parent.list();
    ADD_FAILURE() << "it was listed";
  } catch (const std::runtime_error& problem) {
    EXPECT_THAT(problem.what(), HasSubstr(file.string()));
    EXPECT_THAT(problem.what(), HasSubstr("telehug pair revoke " + pair.id));
  }
  // One that was never finished is none.
  fs::remove(file);
  EXPECT_TRUE(parent.list().empty());
}

TEST_F(Pairs, WithFilesOfAnotherPairAreNamed) {
  PairStore father(folder / "father", Side::active);
  const Pair mothers = pair_up(parent, wearer).parent;
  const Pair fathers = pair_up(father, wearer).parent;
  const auto exchanged = [&](auto file) {
    Pair mixed = mothers;
    mixed.files.*file = fathers.files.*file;
    return only_fault(parent, mixed);
  };
  EXPECT_THAT(exchanged(&DdsSecurityFiles::private_key).what, HasSubstr("not the certificate's key"));
  EXPECT_THAT(exchanged(&DdsSecurityFiles::permissions).what, HasSubstr("not signed by the pair's authority"));
  Pair wrong_place = mothers;
  wrong_place.partition = fathers.partition;
  EXPECT_EQ(only_fault(parent, wrong_place).file, mothers.files.permissions);
}

TEST_F(Pairs, WithFilesOfAnotherWearerAreNamed) {
  PairStore other_parent(folder / "other-parent", Side::active);
  PairStore other_wearer(folder / "other-wearer", Side::passive);
  Pair mixed = pair_up(parent, wearer).parent;
  const Pair other = pair_up(other_parent, other_wearer).parent;
  mixed.files.identity_ca = other.files.identity_ca;
  EXPECT_THAT(only_fault(parent, mixed).what, HasSubstr("identity authority"));
  mixed = parent.list().at(0);
  mixed.files.governance = other.files.governance;
  EXPECT_EQ(only_fault(parent, mixed).file, other.files.governance);
}

}  // namespace
}  // namespace telehug
