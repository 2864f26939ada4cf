// SPDX-License-Identifier: Apache-2.0
#include "service/control_socket.hpp"

#include <gmock/gmock.h>
#include <grp.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "doubles/temporary_folder.hpp"
#include "integration/service/raw_connection.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ControlSocketTest : public testing::Test {
 protected:
  std::string failure(const std::string& group = "") {
    try {
      const ControlSocket socket(path_, group);
      return "";
    } catch (const std::exception& problem) {
      return problem.what();
    }
  }
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "run" / "test.sock";
};

TEST_F(ControlSocketTest, IsForOwnerAndGroupOnlyAndGoesAway) {
  {
    const ControlSocket socket(path_, "");
    struct stat status {};
    ASSERT_EQ(stat(path_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0660U);
    EXPECT_TRUE(RawConnection(path_).connected());
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(ControlSocketTest, IsRefusedToASecondDaemon) {
  const ControlSocket first(path_, "");
  EXPECT_THROW(ControlSocket(path_, ""), AlreadyRunning);
  EXPECT_THAT(failure(), HasSubstr("another telehug daemon already serves"));
  EXPECT_TRUE(RawConnection(path_).connected());
}

TEST_F(ControlSocketTest, IsRefusedWhenSomebodyAnswersThoughTheLockIsGone) {
  const ControlSocket first(path_, "");
  std::filesystem::remove(path_.string() + ".lock");
  EXPECT_THROW(ControlSocket(path_, ""), AlreadyRunning);
  EXPECT_TRUE(RawConnection(path_).connected());
}

TEST_F(ControlSocketTest, ReplacesWhatAKilledDaemonLeft) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const ControlSocket socket(path_, "");
    (void)!write(ready[1], "x", 1);
    pause();
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  close(ready[0]);
  close(ready[1]);
  ASSERT_TRUE(std::filesystem::exists(path_));
  EXPECT_EQ(failure(), "");
}

TEST_F(ControlSocketTest, LeavesAFileAloneThatIsNoSocket) {
  folder_.write("run/test.sock", "precious");
  EXPECT_THAT(failure(), HasSubstr("isn't a socket"));
  EXPECT_EQ(std::filesystem::file_size(path_), 8U);
}

TEST_F(ControlSocketTest, TellsOfAGroupThatDoesNotExistAndLeavesNothing) {
  EXPECT_THAT(failure("no-such-group-here"),
              AllOf(HasSubstr("control.group = \"no-such-group-here\": there is no such group on this PC"),
                    HasSubstr("`sudo usermod -aG telehug NAME`")));
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_THROW(ControlSocket(path_, "no-such-group-here"), GroupUnusable);
}

TEST_F(ControlSocketTest, TellsOfAGroupThatItMayNotBeGivenToAndLeavesNothing) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become somebody who is in no group";
  std::filesystem::create_directories(path_.parent_path());
  for (const auto& folder : {folder_.path(), path_.parent_path()})
    ASSERT_EQ(chown(folder.c_str(), 65534, 65534), 0);
  EXPECT_EXIT(
      {
        const bool changed = setgroups(0, nullptr) == 0 && setgid(65534) == 0 && setuid(65534) == 0;
        std::fputs((changed ? failure("root") : "nothing was tried").c_str(), stderr);
        std::exit(std::filesystem::exists(path_) ? 1 : 0);
      },
      testing::ExitedWithCode(0),
      AllOf(HasSubstr("control.group = \"root\": this account may not give its socket to that group"),
            HasSubstr("Leave it empty")));
}

TEST_F(ControlSocketTest, TellsOfAPathThatIsTooLong) {
  path_ = folder_.path() / std::string(200, 'x');
  EXPECT_THAT(failure(), HasSubstr("longer than 107 bytes"));
}

TEST_F(ControlSocketTest, DoesNotTrustAFolderOfAnotherUser) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder to another user";
  std::filesystem::create_directories(path_.parent_path());
  ASSERT_EQ(chown(path_.parent_path().c_str(), 12345, 12345), 0);
  EXPECT_THAT(failure(), HasSubstr("belongs to another user"));
}

TEST(UsualControlSockets, AreWhereTheDaemonsPutThem) {
  const char* before = std::getenv("XDG_RUNTIME_DIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("XDG_RUNTIME_DIR", "/run/user/7", 1);
  EXPECT_EQ(default_control_socket(Side::active), "/run/user/7/telehug/active.sock");
  EXPECT_EQ(usual_control_sockets(Side::active).front(), "/run/user/7/telehug/active.sock");
  setenv("RUNTIME_DIRECTORY", "/run/telehug:/run/other", 1);
  EXPECT_EQ(default_control_socket(Side::passive), "/run/telehug/passive.sock");
  EXPECT_EQ(usual_control_sockets(Side::passive).back(), "/run/telehug/passive.sock");
  unsetenv("RUNTIME_DIRECTORY");
  unsetenv("XDG_RUNTIME_DIR");
  const auto usual = usual_control_sockets(Side::active);
  EXPECT_THAT(usual, testing::Contains(default_control_socket(Side::active)));
  if (before != nullptr) setenv("XDG_RUNTIME_DIR", kept.c_str(), 1);
}

}  // namespace
}  // namespace telehug
