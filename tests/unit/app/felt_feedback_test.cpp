// SPDX-License-Identifier: Apache-2.0
//
// The thread at the toucher's own actuator, on a terminal of the test's.
#include "feedback/felt_feedback.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "doubles/pseudo_terminal.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* legacy_ring = R"(
version = 2
name = "Legacy ring"
baud = 9600
protocol = "legacy"
uncovered = "none"
rendering = "boxes"
[[actuator]]
id = 1
name = "fingertip"
kind = "motor"
channel = 4
x_fh = 0.0
y_fh = 0.0
side = "front"
max_strength = 1
min_strength = 1
)";

Felt touch_felt() {
  Felt felt;
  felt.outcome = FeltOutcome::driven;
  felt.phase = Phase::down;
  return felt;
}

// Until a legacy actuator counts as there.
bool becomes_ready(const FeltFeedback& feedback) {
  const SteadyClock clock;
  for (const Timestamp deadline = clock.now() + 10s; clock.now() < deadline;) {
    if (feedback.problem().empty()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(FeltFeedback, SaysTheNumberOfALegacyActuatorButNotWhileItIsStopped) {
  const TemporaryFolder folder;
  const PseudoTerminal port;
  const SteadyClock clock;
  const auto made = FeltFeedback::make(
      {.link = "serial:" + port.path(), .profile = folder.write("ring.toml", legacy_ring).string(), .strength = 0.6},
      clock);
  ASSERT_TRUE(made) << made.error().message;
  FeltFeedback& feedback = **made;
  EXPECT_NE(feedback.problem(), "") << "it is not there yet";
  ASSERT_TRUE(becomes_ready(feedback)) << feedback.problem();
  feedback.felt(touch_felt());
  EXPECT_THAT(port.read(1), ElementsAre(5));
  feedback.set_stopped(true);
  for (int i = 0; i < 40; ++i) {
    feedback.felt(touch_felt());
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_FALSE(port.has_bytes());
  feedback.set_stopped(false);
  feedback.felt(touch_felt());
  EXPECT_THAT(port.read(1), ElementsAre(5));
}

TEST(FeltFeedback, IsNoneUnlessALinkIsConfigured) {
  const SteadyClock clock;
  const auto made = FeltFeedback::make({}, clock);
  ASSERT_TRUE(made);
  EXPECT_EQ(*made, nullptr);
}

TEST(FeltFeedback, TellsWhatIsWrongWithItsProfileOrItsLink) {
  const SteadyClock clock;
  const auto no_profile = FeltFeedback::make({.link = "serial:/dev/null", .profile = "/nonexistent.toml"}, clock);
  ASSERT_FALSE(no_profile);
  EXPECT_THAT(no_profile.error().message, HasSubstr("/nonexistent.toml"));
  const auto no_link =
      FeltFeedback::make({.link = "carrier pigeon", .profile = TELEHUG_SOURCE "/deploy/jackets/ring-1.toml"}, clock);
  ASSERT_FALSE(no_link);
  EXPECT_THAT(no_link.error().message, HasSubstr("names no jacket"));
}

}  // namespace
}  // namespace telehug
