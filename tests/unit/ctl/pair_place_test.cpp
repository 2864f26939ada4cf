// SPDX-License-Identifier: Apache-2.0
#include "ctl/pair_place.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include "config/places.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class PlaceOfPairs : public testing::Test {
 protected:
  // Root gives it an account of its own; for anybody else it is as if it ran as themselves.
  void install_service() const {
    std::filesystem::create_directories(folder / "var/lib/telehug");
    if (geteuid() != 0) return;
    ASSERT_EQ(chown((folder / "var/lib/telehug").c_str(), service, service), 0);
  }
  [[nodiscard]] Result<std::filesystem::path> place(Side side, uid_t caller) const {
    return place_of_pairs(side, sources, "accept CODE", caller, folder.path());
  }

  TemporaryFolder folder;
  ConfigSources sources{.system_folder = folder / "etc", .user_folder = {}, .only_file = {}, .overrides = {}};
  const uid_t service = geteuid() == 0 ? 4711 : geteuid();
  const uid_t somebody = service + 1;
};

TEST_F(PlaceOfPairs, IsWhereTheConfigurationOfTheSideSays) {
  install_service();
  folder.write("etc/active.toml", "[peer]\npairs_folder = \"/a/parents\"\n");
  folder.write("etc/passive.toml", "[peer]\npairs_folder = \"/a/wearers\"\nno_such_key = 1\n");
  EXPECT_EQ(place(Side::active, somebody).value(), "/a/parents");
  EXPECT_EQ(place(Side::passive, somebody).value(), "/a/wearers") << "who may write there is for the folder to say";
}

TEST_F(PlaceOfPairs, IsElseInTheStateFolder) {
  EXPECT_EQ(place(Side::active, somebody).value(), pairs_folder({}, Side::active));
  EXPECT_EQ(place(Side::passive, somebody).value(), pairs_folder({}, Side::passive)) << "there is no service";
  install_service();
  EXPECT_EQ(place(Side::active, somebody).value(), pairs_folder({}, Side::active));
}

TEST_F(PlaceOfPairs, OfAServiceIsForRootAndItsAccountAlone) {
  install_service();
  const auto refused = place(Side::passive, somebody);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr("`sudo telehug pair accept CODE`"),
                                             HasSubstr("--folder " + pairs_folder({}, Side::passive).string())));
  for (const uid_t caller : {uid_t{0}, service})
    EXPECT_EQ(place(Side::passive, caller).value(), pairs_folder({}, Side::passive));
}

}  // namespace
}  // namespace telehug
