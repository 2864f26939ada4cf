// SPDX-License-Identifier: Apache-2.0
//
// `telehug stop` on either side turns everything off, and off it stays until that side resumes.
#include <gtest/gtest.h>

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
  if (GetParam() == Side::active) {
    pair.passive->kill_now();
    pair.start_passive();
  } else {
    pair.active->kill_now();
    pair.start_active();
  }
  EXPECT_TRUE(eventually([&] { return stopped(other(GetParam())); })) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", GetParam()).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

// Whoever stopped may have restarted the PC to get out of it: resuming there must do.
TEST_P(Stop, EndsWithAResumeAfterTheSideThatStoppedWasStartedAgain) {
  ASSERT_EQ(pair.telehug("stop", GetParam()).code, 0);
  ASSERT_TRUE(eventually([&] { return all_stopped(); })) << pair.logs();
  ASSERT_TRUE(eventually([&] { return !pair.felt(); })) << pair.logs();
  if (GetParam() == Side::active) {
    pair.active->kill_now();
    pair.start_active();
  } else {
    pair.passive->kill_now();
    pair.start_passive();
  }
  ASSERT_TRUE(eventually([&] {
    const Json answer = pair.status(GetParam());
    return answer.is_object() && answer.at("peer").at("connected").get<bool>();
  })) << pair.logs();
  if (GetParam() == Side::active) {
    EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "the other side is stopped"); })) << pair.logs();
  } else {
    EXPECT_TRUE(pair.complains(Side::active, "the other side has stopped everything")) << pair.logs();
  }
  EXPECT_FALSE(pair.felt()) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", GetParam()).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

INSTANTIATE_TEST_SUITE_P(OnEitherSide, Stop, testing::Values(Side::active, Side::passive),
                         [](const auto& which) { return which.param == Side::active ? "Active" : "Passive"; });

}  // namespace
}  // namespace telehug
