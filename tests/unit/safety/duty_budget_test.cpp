// SPDX-License-Identifier: Apache-2.0
#include "safety/duty_budget.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <deque>
#include <random>

namespace telehug {
namespace {

constexpr Duration step = 10ms;

// A motor that is asked for `wanted` all the time and gets what the budget leaves.
class RunningMotor {
 public:
  RunningMotor(double max_duty, Duration window) : budget_(max_duty, window), window_(window) {}

  double run(double wanted) {
    const double given = std::min(wanted, budget_.most(now));
    now += step;
    budget_.run(given, step, now);
    ran_.push_back(given * 0.01);
    return given;
  }
  // Seconds at strength 1 within the last window.
  [[nodiscard]] double used_s() const {
    double sum = 0;
    const auto steps = std::min(ran_.size(), static_cast<std::size_t>(window_ / step));
    for (std::size_t i = 0; i < steps; ++i)
      sum += ran_[ran_.size() - 1 - i];
    return sum;
  }

  Timestamp now = from_ns(5'000'000'000);

 private:
  DutyBudget budget_;
  Duration window_;
  std::deque<double> ran_;
};

TEST(DutyBudget, lets_a_motor_run_at_full_strength_until_a_fifth_is_left_then_fades) {
  RunningMotor motor(0.5, 10s);
  for (int i = 0; i < 399; ++i)
    ASSERT_EQ(motor.run(1), 1) << i;
  double last = 1;
  for (int i = 0; i < 400; ++i) {
    const double given = motor.run(1);
    ASSERT_LE(given, last);
    last = given;
  }
  EXPECT_LT(last, 0.05);
}

TEST(DutyBudget, tells_the_share_that_is_used_up_and_none_without_a_limit) {
  const Timestamp start = from_ns(5'000'000'000);
  DutyBudget budget(0.5, 10s);
  EXPECT_EQ(budget.used(start), 0);
  budget.run(0.5, 1s, start + 1s);
  EXPECT_NEAR(budget.used(start + 1s), 0.1, 1e-9);
  budget.run(1, 20s, start + 2s);
  EXPECT_EQ(budget.used(start + 2s), 1) << "never more than all of it";
  EXPECT_EQ(budget.used(start + 30s), 0);
  DutyBudget unlimited(1, 10s);
  unlimited.run(1, 10s, start);
  EXPECT_EQ(unlimited.used(start), 0);
}

TEST(DutyBudget, recovers_as_the_window_slides) {
  RunningMotor motor(0.5, 10s);
  for (int i = 0; i < 900; ++i)
    motor.run(1);
  EXPECT_LT(motor.run(1), 0.1);
  for (int i = 0; i < 1000; ++i)
    motor.run(0);
  EXPECT_EQ(motor.run(1), 1) << "a window later nothing counts any more but a part of it";
}

TEST(DutyBudget, never_lets_more_through_than_its_share_of_any_window) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 60; ++round) {
    const double duty = 0.02 + 0.95 * uniform(random);
    const Duration window = std::chrono::milliseconds(500 + random() % 20000);
    RunningMotor motor(duty, window);
    double wanted = 1;
    for (int i = 0; i < 3000; ++i) {
      if (random() % 100 == 0) wanted = random() % 2 == 0 ? 1 : uniform(random);
      motor.run(wanted);
      ASSERT_LE(motor.used_s(), duty * std::chrono::duration<double>(window).count() + 1e-9) << duty;
    }
  }
}

TEST(DutyBudget, counts_a_weak_motor_less) {
  RunningMotor strong(0.3, 10s);
  RunningMotor weak(0.3, 10s);
  int of_strong = 0;
  int of_weak = 0;
  while (strong.run(1) == 1)
    ++of_strong;
  while (weak.run(0.5) == 0.5)
    ++of_weak;
  EXPECT_GT(of_weak, of_strong * 2);
}

TEST(DutyBudget, gives_what_it_gave_before_to_a_motor_that_runs_within_its_share) {
  RunningMotor motor(0.5, 10s);
  for (int i = 0; i < 5000; ++i)
    ASSERT_EQ(motor.run(0.35), 0.35) << i;
}

TEST(DutyBudget, limits_nothing_from_1_on) {
  RunningMotor motor(1, 1s);
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(motor.run(1), 1);
}

TEST(DutyBudget, forgets_nothing_when_the_clock_goes_back_and_recovers_from_then_on) {
  RunningMotor motor(0.5, 10s);
  for (int i = 0; i < 900; ++i)
    motor.run(1);
  motor.now -= 1h;
  EXPECT_LT(motor.run(1), 0.1);
  for (int i = 0; i < 1030; ++i)
    motor.run(0);
  EXPECT_EQ(motor.run(1), 1);
}

TEST(DutyBudget, forgets_everything_after_a_long_time) {
  RunningMotor motor(0.5, 10s);
  for (int i = 0; i < 900; ++i)
    motor.run(1);
  motor.now += 1h;
  EXPECT_EQ(motor.run(1), 1);
}

TEST(DutyBudget, weakens_a_budget_that_is_shorter_than_a_command) {
  DutyBudget budget(0.01, 10s);  // 100 ms
  EXPECT_DOUBLE_EQ(budget.most(from_ns(0)), 0.4);
}

}  // namespace
}  // namespace telehug
