// SPDX-License-Identifier: Apache-2.0
//
// The daemons read their configuration anew on SIGHUP.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "integration/app/running_pair.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::Not;

// Stands for systemd: the datagram socket that $NOTIFY_SOCKET names.
class NotifySocket {
 public:
  explicit NotifySocket(std::filesystem::path path)
      : path_(std::move(path)), fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path_.string().copy(address.sun_path, sizeof address.sun_path - 1);
    if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("no socket at " + path_.string());
  }
  ~NotifySocket() { ::close(fd_); }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }
  // All that was told so far, a message a line.
  [[nodiscard]] std::string told() {
    std::array<char, 1024> buffer{};
    for (ssize_t size = 0; (size = ::recv(fd_, buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
      told_ += std::string(buffer.data(), static_cast<std::size_t>(size)) + "\n";
    return told_;
  }

 private:
  std::filesystem::path path_;
  int fd_;
  std::string told_;
};

class ARunningDaemon : public testing::TestWithParam<Side> {
 protected:
  ARunningDaemon() {
    pair.active_config = pair.passive_config = file();
    pair.active_prefix = pair.passive_prefix = {"/usr/bin/env", "NOTIFY_SOCKET=" + systemd.path()};
    write("");
  }
  void start() {
    GetParam() == Side::active ? pair.start_active() : pair.start_passive();
    ASSERT_TRUE(eventually([this] { return pair.status(GetParam()).is_object(); })) << pair.logs();
    ASSERT_TRUE(eventually([this] { return systemd.told() == "READY=1\n"; })) << systemd.told();
  }
  void write(const std::string& text) const { std::ofstream(file()) << text; }
  [[nodiscard]] ChildProcess& daemon() const { return GetParam() == Side::active ? *pair.active : *pair.passive; }
  // Until systemd knows that it is over.
  [[nodiscard]] bool reload() {
    const std::size_t before = systemd.told().size();
    ::kill(daemon().pid(), SIGHUP);
    return eventually([&] { return systemd.told().find("\nREADY=1\n", before) != std::string::npos; });
  }
  [[nodiscard]] std::filesystem::path file() const { return pair.folder / "side.toml"; }
  [[nodiscard]] std::string log() const { return content_of(pair.folder / (side_name(GetParam()) + ".log")); }

  RunningPair pair;
  NotifySocket systemd{pair.folder / "notify"};
};

TEST_P(ARunningDaemon, TakesWhatMayChangeAndNamesWhatNeedsARestart) {
  start();
  write("[log]\nlevel = \"debug\"\n\n[web]\nport = 1\n");
  ASSERT_TRUE(reload()) << pair.logs();
  EXPECT_THAT(systemd.told(), testing::MatchesRegex("READY=1\nRELOADING=1\nMONOTONIC_USEC=[0-9]+\nREADY=1\n"));
  EXPECT_THAT(log(), HasSubstr("configuration: log.level is \"debug\" now, was \"info\""));
  EXPECT_THAT(log(), HasSubstr("configuration: web.port = 1 needs a restart; 0 is still in use"));
  EXPECT_TRUE(pair.complains(GetParam(), "web.port = 1 needs a restart")) << pair.logs();
  write("");
  ASSERT_TRUE(reload()) << pair.logs();
  EXPECT_FALSE(pair.complains(GetParam(), "web.port")) << pair.logs();
}

TEST_P(ARunningDaemon, KeepsAllWhenTheNewConfigurationIsFaultyAndSaysWhere) {
  start();
  write("[log]\nlevel = \"warn\"\n\n[web]\nport = \"x\"\nprot = 2\n");
  ASSERT_TRUE(reload()) << pair.logs();
  EXPECT_THAT(log(), HasSubstr("configuration: not taken, the one before stays in use"));
  EXPECT_THAT(log(), Not(HasSubstr("\"warn\" now")));
  for (const char* line : {":5: ", ":6: "}) {
    EXPECT_THAT(log(), HasSubstr("configuration: " + file().string() + line));
    EXPECT_TRUE(pair.complains(GetParam(), "configuration: " + file().string() + line)) << pair.logs();
  }
  std::filesystem::remove(file());
  std::filesystem::create_directory(file());
  ASSERT_TRUE(reload()) << pair.logs();
  EXPECT_TRUE(pair.complains(GetParam(), file().string())) << pair.logs();
  std::filesystem::remove(file());
  write("");
  ASSERT_TRUE(reload()) << pair.logs();
  EXPECT_FALSE(pair.complains(GetParam(), "configuration: ")) << pair.logs();
  EXPECT_EQ(daemon().end(), 0);
}

// As fast as they may come, also before the one before is done with.
TEST_P(ARunningDaemon, TakesAHundredReloadsInARow) {
  start();
  for (int i = 0; i < 100; ++i) {
    write(i % 2 == 0 ? "[log]\nlevel = \"debug\"\n" : "[log\n");
    ::kill(daemon().pid(), SIGHUP);
  }
  write("");
  ASSERT_TRUE(reload()) << pair.logs();
  EXPECT_TRUE(eventually([this] { return !pair.complains(GetParam(), "configuration: "); })) << pair.logs();
  EXPECT_EQ(daemon().end(), 0);
}

INSTANTIATE_TEST_SUITE_P(BothSides, ARunningDaemon, testing::Values(Side::active, Side::passive),
                         [](const auto& side) { return side_name(side.param); });

// While a finger is felt.
class AReloadDuringATouch : public testing::Test {
 protected:
  void start() {
    pair.active_config = active_file();
    pair.passive_config = passive_file();
    write(active_file(), "");
    write(passive_file(), "");
    ASSERT_TRUE(pair.start_all()) << pair.logs();
  }
  static void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }
  [[nodiscard]] std::filesystem::path active_file() const { return pair.folder / "active.toml"; }
  [[nodiscard]] std::filesystem::path passive_file() const { return pair.folder / "passive.toml"; }

  RunningPair pair;
};

TEST_F(AReloadDuringATouch, TurnsEverythingOffForQuietHoursAndLetsItBeFeltAgainAfterThem) {
  start();
  write(passive_file(), "[consent]\nquiet_hours = \"00:00-12:00,12:00-00:00\"\n");
  ::kill(pair.passive->pid(), SIGHUP);
  ASSERT_TRUE(eventually([this] { return !pair.felt(); })) << pair.logs();
  EXPECT_EQ(pair.status(Side::passive).at("consent").at("name"), "quiet hours");
  EXPECT_TRUE(eventually([this] { return pair.counter(Side::passive, "off_consent") > 0; })) << pair.logs();
  write(passive_file(), "");
  ::kill(pair.passive->pid(), SIGHUP);
  EXPECT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
}

TEST_F(AReloadDuringATouch, LoosensNoLimitAndEndsNoStop) {
  start();
  ASSERT_EQ(pair.passive->end(), 0);
  write(passive_file(), "[safety]\nmax_strength = 0.2\n");  // below what turns a motor
  pair.start_passive();
  const auto refused = [this] { return pair.counter(Side::passive, "safety_refused_by_limit"); };
  ASSERT_TRUE(eventually([&] { return refused() > 0; })) << pair.logs();
  const auto silent = pair.pins().size();
  write(passive_file(), "[safety]\nmax_strength = 1.0\n");
  ::kill(pair.passive->pid(), SIGHUP);
  ASSERT_TRUE(eventually([this] {
    return pair.complains(Side::passive, "safety.max_strength = 1.0 needs a restart; 0.2 is still in use");
  })) << pair.logs();
  const auto before = refused();
  ASSERT_TRUE(eventually([&] { return refused() > before + 5; })) << pair.logs();
  EXPECT_EQ(pair.pins().size(), silent) << "the limit is still in use";

  ASSERT_EQ(pair.passive->end(), 0);
  pair.start_passive();
  ASSERT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
  ASSERT_EQ(pair.telehug("stop", Side::passive).code, 0);
  const auto stopped = [this] { return !pair.felt() && pair.status(Side::passive).at("state") == "stopped"; };
  ASSERT_TRUE(eventually(stopped)) << pair.logs();
  const auto changes = pair.pins().size();
  write(passive_file(), "[log]\nlevel = \"debug\"\n");
  ::kill(pair.passive->pid(), SIGHUP);
  ASSERT_TRUE(eventually(
      [this] { return content_of(pair.folder / "passive.log").find("\"debug\" now") != std::string::npos; }));
  EXPECT_TRUE(stopped()) << pair.logs();
  EXPECT_EQ(pair.pins().size(), changes);
}

TEST_F(AReloadDuringATouch, GoesOnFeelingItWhenAFileIsFaulty) {
  start();
  const auto changes = pair.pins().size();
  write(passive_file(), "[safety]\nmax_strength = 7\n");
  ::kill(pair.passive->pid(), SIGHUP);
  ASSERT_TRUE(eventually([this] { return pair.complains(Side::passive, "passive.toml:2: "); })) << pair.logs();
  write(active_file(), "[touch]\nmodel = \"thesis\"\n");
  ::kill(pair.active->pid(), SIGHUP);
  ASSERT_TRUE(eventually([this] { return pair.complains(Side::active, "wants the thesis'"); })) << pair.logs();
  EXPECT_EQ(pair.status(Side::active).at("calibrated"), true) << "what was in use before still is";
  EXPECT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
  EXPECT_GE(pair.pins().size(), changes);
}

TEST_F(AReloadDuringATouch, ChangesHowFingersAreFound) {
  start();
  ASSERT_EQ(pair.status(Side::active).at("detector").at("name"), "default");
  write(active_file(), "[touch]\ndetector = \"thesis\"\n");
  ::kill(pair.active->pid(), SIGHUP);
  EXPECT_TRUE(eventually([this] { return pair.status(Side::active).at("detector").at("name") == "thesis"; }))
      << pair.logs();
}

}  // namespace
}  // namespace telehug
