// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/restore_token.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

unsigned permissions(const std::filesystem::path& file) {
  struct stat found {};
  return ::lstat(file.c_str(), &found) == 0 ? found.st_mode & 07777U : 0U;
}

class RestoreTokenTest : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::filesystem::path file = folder / "state/token";
};

TEST_F(RestoreTokenTest, IsReadAsItWasWritten) {
  EXPECT_EQ(read_restore_token(file), "");
  ASSERT_TRUE(write_restore_token(file, "0a1b-2c3d"));
  EXPECT_EQ(read_restore_token(file), "0a1b-2c3d");
  ASSERT_TRUE(write_restore_token(file, "another"));
  EXPECT_EQ(read_restore_token(file), "another");
  remove_restore_token(file);
  EXPECT_EQ(read_restore_token(file), "");
}

TEST_F(RestoreTokenTest, IsForItsOwnersEyesOnlyWhateverLayThereBefore) {
  folder.write("state/token", "old");
  ::chmod(file.c_str(), 0666);
  const auto elsewhere = folder.write("elsewhere", "mine");
  std::filesystem::create_symlink(elsewhere, folder / "state/token.new");
  ASSERT_TRUE(write_restore_token(file, "new"));
  EXPECT_EQ(permissions(file), 0600U);
  EXPECT_EQ(std::filesystem::file_size(elsewhere), 4U) << "no link is followed";
  EXPECT_FALSE(std::filesystem::exists(folder / "state/token.new"));
}

TEST_F(RestoreTokenTest, IsNotReadThroughALinkOrFromAFolder) {
  std::filesystem::create_directories(folder / "state");
  std::filesystem::create_symlink(folder.write("elsewhere", "secret"), file);
  EXPECT_EQ(read_restore_token(file), "");
  EXPECT_EQ(read_restore_token(folder / "state"), "");
}

TEST_F(RestoreTokenTest, IsNothingThatCantBeOne) {
  const std::string longest(1024, 'x');
  for (const std::string& odd : {std::string(), std::string("two words"), std::string("two\nlines"),
                                 std::string("zero\0byte", 9), std::string("\xff"), longest + 'x'}) {
    ASSERT_TRUE(write_restore_token(file, "good"));
    EXPECT_FALSE(write_restore_token(file, odd));
    EXPECT_FALSE(std::filesystem::exists(file)) << "the one before is used up";
    folder.write("state/token", odd);
    EXPECT_EQ(read_restore_token(file), "");
  }
  ASSERT_TRUE(write_restore_token(file, longest));
  EXPECT_EQ(read_restore_token(file), longest);
}

TEST_F(RestoreTokenTest, SaysWhyItCantBeKept) {
  folder.write("state", "a file where the folder should be");
  const Status written = write_restore_token(file, "secret");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find(file.string()), std::string::npos);
  EXPECT_EQ(written.error().message.find("secret"), std::string::npos);
}

}  // namespace
}  // namespace telehug
