// SPDX-License-Identifier: Apache-2.0
//
// Whatever breaks while a motor runs, every pin falls silent. The limit of 300 ms is asserted in the chip's virtual
// time (test_firmware, test_jacket); here processes are measured on a PC that may be busy, and twice that must do.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>

#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

constexpr double longest_ms = 600;
constexpr int times = 5;

class Silence : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(pair.start_all()) << pair.logs(); }

  // Breaks something, mends it, and waits until the finger is felt again, some times over.
  void break_and_mend(const char* what, const std::function<void()>& break_it, const std::function<void()>& mend_it) {
    double worst_ms = 0;
    for (int i = 0; i < times; ++i) {
      ASSERT_TRUE(eventually([this] { return settled(); })) << "not felt without a gap" << pair.logs();
      const auto took_ms = pair.ms_to_silence(break_it);
      ASSERT_TRUE(took_ms) << "no motor ran, or one went on" << pair.logs();
      worst_ms = std::max(worst_ms, *took_ms);
      mend_it();
      ASSERT_TRUE(eventually([this] { return pair.felt(); })) << "not felt again" << pair.logs();
    }
    fmt::print("silent after {}: worst of {} {:.0f} ms\n", what, times, worst_ms);
    EXPECT_LE(worst_ms, longest_ms) << pair.logs();
  }

  // After a break motors may run, lose the sender's heartbeat once more and run again.
  [[nodiscard]] bool settled() const {
    const auto pins = pair.pins();
    return !pins.empty() && pins.back().on && SteadyClock{}.now() - from_ns(pins.back().time_ns) > 400ms;
  }

  RunningPair pair;
};

TEST_F(Silence, FollowsWhenTheActiveSideIsKilled) {
  break_and_mend(
      "SIGKILL of telehug-active", [this] { pair.active->kill_now(); }, [this] { pair.start_active(); });
}

TEST_F(Silence, FollowsWhenThePassiveSideIsKilled) {
  break_and_mend(
      "SIGKILL of telehug-passive", [this] { pair.passive->kill_now(); }, [this] { pair.start_passive(); });
}

TEST_F(Silence, FollowsWhenTheActiveSideHangs) {
  break_and_mend(
      "SIGSTOP of telehug-active", [this] { kill(pair.active->pid(), SIGSTOP); },
      [this] { kill(pair.active->pid(), SIGCONT); });
}

TEST_F(Silence, FollowsWhenThePassiveSideHangs) {
  break_and_mend(
      "SIGSTOP of telehug-passive", [this] { kill(pair.passive->pid(), SIGSTOP); },
      [this] { kill(pair.passive->pid(), SIGCONT); });
}

TEST_F(Silence, FollowsWhenTheJacketHearsNothingMore) {
  const auto cut_or_join = [this] { kill(pair.jacket->pid(), SIGUSR1); };
  break_and_mend("cutting the firmware's input", cut_or_join, cut_or_join);
}

}  // namespace
}  // namespace telehug
