// SPDX-License-Identifier: Apache-2.0
//
// `telehug stop` on either side turns everything off, and off it stays until that side resumes.
#include <gtest/gtest.h>

#include <fstream>

#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

class Stop : public testing::TestWithParam<Side> {
 protected:
  void SetUp() override { ASSERT_TRUE(pair.start_all()) << pair.logs(); }

  static Side other(Side side) { return side == Side::active ? Side::passive : Side::active; }
  [[nodiscard]] bool stopped(Side side) const {
    const Json answer = pair.status(side);
    return answer.is_object() && answer.at("state") == "stopped";
  }
  // Both sides say so, and every pin is off.
  [[nodiscard]] bool all_stopped() const { return stopped(Side::active) && stopped(Side::passive) && !pair.felt(); }

  [[nodiscard]] bool connected(Side side) const {
    const Json answer = pair.status(side);
    return answer.is_object() && answer.at("peer").at("connected").get<bool>();
  }
  void kill_and_start(Side side) {
    if (side == Side::active) {
      pair.active->kill_now();
      pair.start_active();
    } else {
      pair.passive->kill_now();
      pair.start_passive();
    }
  }

  RunningPair pair;
};

TEST_P(Stop, TurnsEverythingOffUntilResumed) {
  ASSERT_EQ(pair.telehug("stop", GetParam()).code, 0);
  ASSERT_TRUE(eventually([&] { return all_stopped(); })) << pair.logs();
  EXPECT_TRUE(pair.complains(GetParam(), "stopped here: stopped with the telehug command")) << pair.logs();
  EXPECT_TRUE(pair.complains(other(GetParam()), "the other side has stopped everything")) << pair.logs();
  EXPECT_TRUE(eventually([&] { return !pair.camera_open(); })) << pair.logs();

  // The other side can't end it.
  const auto changes = pair.pins().size();
  EXPECT_EQ(pair.telehug("resume", other(GetParam())).code, 0);
  EXPECT_TRUE(all_stopped()) << pair.logs();

  EXPECT_EQ(pair.telehug("resume", GetParam()).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_TRUE(eventually([&] { return !stopped(Side::active) && !stopped(Side::passive); })) << pair.logs();
  EXPECT_EQ(pair.pins().size(), changes + pair.running().size()) << "nothing moved before" << pair.logs();
}

TEST_P(Stop, HoldsForAPeerThatIsStartedAgain) {
  ASSERT_EQ(pair.telehug("stop", GetParam()).code, 0);
  ASSERT_TRUE(eventually([&] { return all_stopped(); })) << pair.logs();
  kill_and_start(other(GetParam()));
  EXPECT_TRUE(eventually([&] { return stopped(other(GetParam())); })) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", GetParam()).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST_P(Stop, OutlivesAKillOfItsOwnDaemonUntilResumed) {
  const Side side = GetParam();
  ASSERT_EQ(pair.telehug("stop", side, {"--reason", "dinner"}).code, 0);
  ASSERT_TRUE(eventually([&] { return all_stopped(); })) << pair.logs();
  const auto changes = pair.pins().size();
  kill_and_start(side);
  ASSERT_TRUE(eventually([&] { return connected(side); })) << pair.logs();
  EXPECT_TRUE(pair.complains(side, "stopped here: dinner")) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.complains(other(side), "the other side has stopped everything"); }))
      << pair.logs();
  EXPECT_TRUE(all_stopped()) << pair.logs();
  EXPECT_EQ(pair.pins().size(), changes) << "nothing has moved meanwhile" << pair.logs();

  EXPECT_EQ(pair.telehug("resume", side).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  kill_and_start(side);
  EXPECT_TRUE(eventually([&] { return connected(side); })) << pair.logs();
  EXPECT_FALSE(pair.complains(side, "stopped here")) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST_P(Stop, IsAssumedIfItsFileIsDamagedAndEndsWithAResume) {
  const Side side = GetParam();
  std::ofstream(pair.stop_file(side)) << "{\"format\":1,\"rea";
  kill_and_start(side);
  ASSERT_TRUE(eventually([&] { return connected(side) && stopped(side); })) << pair.logs();
  EXPECT_TRUE(pair.complains(side, "is damaged")) << pair.logs();
  EXPECT_TRUE(eventually([&] { return !pair.felt(); })) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", side).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_FALSE(pair.complains(side, "is damaged")) << pair.logs();
  EXPECT_FALSE(std::filesystem::exists(pair.stop_file(side)));
}

// Nothing can be written below a file, not even by root.
TEST_P(Stop, TakesEffectAndSaysThatItWillNotLastIfItsFileCannotBeWritten) {
  const Side side = GetParam();
  const auto file = pair.folder.write("no-folder", "") / "stop.json";
  (side == Side::active ? pair.active_settings : pair.passive_settings).push_back("control.stop_file=" + file.string());
  kill_and_start(side);
  ASSERT_TRUE(eventually([&] { return connected(side); })) << pair.logs();
  ASSERT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_EQ(pair.telehug("stop", side).code, 0);
  EXPECT_TRUE(eventually([&] { return all_stopped(); })) << pair.logs();
  EXPECT_TRUE(pair.complains(side, "the stop will not outlive a restart: " + file.string())) << pair.logs();

  // The other side holds it, as ever; whoever restarted to get out of it may resume there.
  kill_and_start(side);
  ASSERT_TRUE(eventually([&] { return connected(side); })) << pair.logs();
  EXPECT_FALSE(pair.complains(side, "stopped here")) << pair.logs();
  if (side == Side::active) {
    EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "the other side is stopped"); })) << pair.logs();
  } else {
    EXPECT_TRUE(pair.complains(Side::active, "the other side has stopped everything")) << pair.logs();
  }
  EXPECT_FALSE(pair.felt()) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", side).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

// Nobody else knows of it: the parent's PC is off when it is said.
TEST(AStopOfTheWearer, WhileTheParentsPcIsOffHoldsAfterAKillWhenThatPcIsThere) {
  RunningPair pair;
  pair.start_jacket();
  pair.start_passive();
  ASSERT_TRUE(eventually([&] { return pair.jacket_state() == "armed"; })) << pair.logs();
  ASSERT_EQ(pair.telehug("stop", Side::passive, {"--reason", "enough"}).code, 0);
  pair.passive->kill_now();
  pair.start_passive();
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.start_active();
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "the other side has stopped everything"); }))
      << pair.logs();
  EXPECT_TRUE(pair.complains(Side::passive, "stopped here: enough")) << pair.logs();
  EXPECT_TRUE(pair.pins().empty()) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", Side::passive).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

INSTANTIATE_TEST_SUITE_P(OnEitherSide, Stop, testing::Values(Side::active, Side::passive),
                         [](const auto& which) { return which.param == Side::active ? "Active" : "Passive"; });

}  // namespace
}  // namespace telehug
