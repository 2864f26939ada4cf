// SPDX-License-Identifier: Apache-2.0
//
// The toucher feels that their touch was felt: a second simulated microcontroller, at the active side.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

class TheTouchersActuator : public testing::Test {
 protected:
  void SetUp() override {
    ring = std::make_unique<ChildProcess>(
        std::vector<std::string>{TELEHUG_BIN "/telehug-jacket-sim", "--link", pair.folder / "ring", "--pins",
                                 pair.folder / "ring.csv", "--die-with-parent"},
        pair.folder / "ring.log");
    pair.active_settings.insert(pair.active_settings.end(),
                                {"feedback.link=serial:" + (pair.folder / "ring").string(),
                                 "feedback.profile=" TELEHUG_SOURCE "/deploy/jackets/ring-1.toml"});
  }
  [[nodiscard]] bool ring_ready() const {
    return pair.status(Side::active).is_object() &&
           !pair.complains(Side::active, "the actuator at the toucher's finger");
  }
  [[nodiscard]] std::vector<PinChange> ring_pins() const {
    const auto log = pair.folder / "ring.csv";
    return std::filesystem::exists(log) ? read_pins(log) : std::vector<PinChange>{};
  }

  RunningPair pair;
  std::unique_ptr<ChildProcess> ring;
};

TEST_F(TheTouchersActuator, PulsesWhenATouchIsFeltAndIsSilentAgain) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  ASSERT_TRUE(eventually([&] { return ring_ready(); })) << pair.logs();
  // The next answer: the finger rests on, so what was stopped begins anew.
  ASSERT_EQ(pair.telehug("stop", Side::passive).code, 0);
  ASSERT_TRUE(eventually([&] { return !pair.felt(); }));
  const auto before = ring_pins().size();
  ASSERT_EQ(pair.telehug("resume", Side::passive).code, 0);
  ASSERT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  ASSERT_TRUE(eventually([&] { return ring_pins().size() > before; })) << pair.logs();
  ASSERT_TRUE(eventually([&] { return !ring_pins().back().on; })) << pair.logs();
  for (const PinChange& change : ring_pins())
    EXPECT_EQ(change.channel, 0);
}

TEST_F(TheTouchersActuator, StaysStillWhenNothingIsFelt) {
  pair.passive_settings.emplace_back("safety.max_strength=0");
  pair.start_jacket();
  pair.start_passive();
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return ring_ready() && pair.counter(Side::passive, "events_accepted") > 30; }))
      << pair.logs();
  EXPECT_TRUE(ring_pins().empty());
}

TEST_F(TheTouchersActuator, IsMissedWhenItIsNotThere) {
  ring.reset();
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return pair.complains(Side::active, "the actuator at the toucher's finger"); }))
      << pair.logs();
}

}  // namespace
}  // namespace telehug
