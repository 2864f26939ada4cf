// SPDX-License-Identifier: Apache-2.0
//
// Whatever went away and comes back is taken up again, without anybody touching the rest.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <random>

#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

class Recovery : public testing::Test {
 protected:
  static std::vector<char> random_bytes(std::size_t count) {
    std::mt19937 random(20261122);
    std::uniform_int_distribution<int> byte(0, 255);
    std::vector<char> bytes(count);
    for (char& each : bytes)
      each = static_cast<char>(byte(random));
    return bytes;
  }

  RunningPair pair;
};

TEST_F(Recovery, AJacketThatComesBackIsUsedAgainAndIsMissedMeanwhile) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  pair.jacket->kill_now();
  std::filesystem::remove(pair.folder / "pins.csv");
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::passive, "no jacket answers"); })) << pair.logs();
  EXPECT_NE(pair.jacket_state(), "armed");
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "no jacket answers"); })) << pair.logs();
  pair.start_jacket();
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.jacket_state() == "armed"; })) << pair.logs();
  EXPECT_FALSE(pair.complains(Side::passive, "no jacket answers"));
}

TEST_F(Recovery, AnActiveSideThatIsStartedAgainIsFeltAgain) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  EXPECT_EQ(pair.active->end(), 0);
  EXPECT_TRUE(eventually([&] { return !pair.felt(); })) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::passive, "no peer is connected"); })) << pair.logs();
  pair.start_active();
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_TRUE(pair.passive->runs());
}

TEST_F(Recovery, AFingerIsFeltOnAfterANewCalibration) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  ASSERT_TRUE(eventually([&] { return pair.counter(Side::passive, "events_accepted") > 60; })) << pair.logs();
  const std::uint32_t before = pair.status(Side::active).at("face").at("map_version");
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  ASSERT_TRUE(eventually([&] {
    return pair.status(Side::active).at("face").at("map_version").get<std::uint32_t>() > before + 1000;
  })) << "it is not in use"
      << pair.logs();
  const std::uint64_t accepted = pair.counter(Side::passive, "events_accepted");
  EXPECT_TRUE(eventually([&] { return pair.felt() && pair.counter(Side::passive, "events_accepted") > accepted + 10; }))
      << pair.logs();
  EXPECT_EQ(pair.counter(Side::passive, "events_doubled"), 0U);
}

TEST_F(Recovery, ASideWhosePeerFellSilentSetsUpItsConnectionAnewAndKeepsToTheStop) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  ASSERT_EQ(pair.telehug("stop", Side::active).code, 0);
  const auto stopped = [&] { return pair.status(Side::passive).value("state", "") == "stopped"; };
  ASSERT_TRUE(eventually(stopped)) << pair.logs();
  EXPECT_EQ(pair.status(Side::passive).at("link"), (Json{{"replaced", 0}, {"last_reason", ""}}));

  pair.active->kill_now();
  const Json replaced = {{"replaced", 1}, {"last_reason", "the other side fell silent"}};
  ASSERT_TRUE(eventually([&] { return pair.status(Side::passive).at("link") == replaced; })) << pair.logs();
  pair.start_active();
  const auto connected = [&](Side side) {
    const Json answer = pair.status(side);
    return answer.is_object() && answer.at("peer").at("connected") == true;
  };
  ASSERT_TRUE(eventually([&] { return connected(Side::active) && connected(Side::passive); })) << pair.logs();
  EXPECT_TRUE(stopped()) << "a new connection lifts no stop" << pair.logs();
  EXPECT_FALSE(pair.felt());
  EXPECT_EQ(pair.telehug("resume", Side::active).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST_F(Recovery, APassiveSideThatIsStartedAgainFeelsAgain) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  EXPECT_EQ(pair.passive->end(), 0) << pair.logs();
  EXPECT_TRUE(eventually([&] { return !pair.felt(); })) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "no peer is connected"); })) << pair.logs();
  pair.start_passive();
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_TRUE(pair.active->runs());
}

TEST_F(Recovery, APassiveSideWithoutItsJacketLivesAndTakesItWhenItIsPluggedIn) {
  pair.start_passive();
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::passive, "can't open"); })) << pair.logs();
  EXPECT_EQ(pair.jacket_state(), "absent");
  pair.start_jacket();
  EXPECT_TRUE(eventually([&] { return pair.jacket_state() == "armed"; })) << pair.logs();
}

TEST_F(Recovery, GarbageOnTheWayToTheJacketMovesNoOtherMotorAndPasses) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  const auto touched = pair.running();
  const std::vector<char> garbage = random_bytes(512);
  const int port = open((pair.folder / "jacket").c_str(), O_WRONLY | O_NOCTTY);
  ASSERT_GE(port, 0);
  EXPECT_EQ(write(port, garbage.data(), garbage.size()), static_cast<ssize_t>(garbage.size()));
  close(port);
  const auto answered = pair.counter(Side::passive, "jacket_frames_received");
  EXPECT_TRUE(eventually([&] { return pair.counter(Side::passive, "jacket_frames_received") > answered + 20; }))
      << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.running() == touched; })) << pair.logs();
  EXPECT_EQ(pair.jacket_state(), "armed");
  for (const PinChange& change : pair.pins())
    EXPECT_TRUE(touched.contains(change.channel)) << change.channel;
}

TEST_F(Recovery, ADeviceThatTalksNonsenseIsCountedAndNeverArmed) {
  const int device = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  ASSERT_GE(device, 0);
  ASSERT_EQ(grantpt(device), 0);
  ASSERT_EQ(unlockpt(device), 0);
  std::array<char, 64> name{};
  ASSERT_EQ(ptsname_r(device, name.data(), name.size()), 0);
  pair.jacket_link = std::string("serial:") + name.data();
  pair.start_passive();
  const std::vector<char> garbage = random_bytes(256);
  EXPECT_TRUE(eventually([&] {
    std::array<char, 1024> heard{};
    while (read(device, heard.data(), heard.size()) > 0) {
    }
    (void)!write(device, garbage.data(), garbage.size());
    return pair.counter(Side::passive, "jacket_malformed_frames") > 10;
  })) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::passive, "no jacket answers")) << pair.logs();
  EXPECT_NE(pair.jacket_state(), "armed");
  EXPECT_EQ(pair.passive->end(), 0) << pair.logs();
  close(device);
}

}  // namespace
}  // namespace telehug
