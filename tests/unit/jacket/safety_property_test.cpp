// SPDX-License-Identifier: Apache-2.0
//
// Whatever comes in, what reaches the jacket stays within every limit and ends.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "doubles/fake_jacket_link.hpp"
#include "rendering/jacket_renderer.hpp"
#include "safety/safety_stage.hpp"
#include "unit/jacket/adversary.hpp"
#include "unit/jacket/jacket_builders.hpp"
#include "unit/safety/power_log.hpp"

namespace telehug {
namespace {

// A daemon that lives through everything that can happen to it, on a fake clock, checked at every step.
class HauntedJacket {
 public:
  explicit HauntedJacket(std::uint32_t seed)
      : adversary_(seed),
        profile_(random_profile(adversary_)),
        limits_{adversary_.real(0, 1), std::chrono::milliseconds(adversary_.whole(1, 2000)),
                std::chrono::milliseconds(adversary_.whole(1, 250)), adversary_.real(30, 40)},
        safety_(std::make_unique<FakeJacketLink>(jacket_), profile_, limits_) {
    for (const Actuator& actuator : profile_.actuators) {
      if (actuator.kind == ActuatorKind::heater) continue;
      by_channel_.at(actuator.channel) = &actuator;
      most_.at(actuator.channel) = std::min(actuator.max_strength, limits_.max_strength);
    }
  }

  // One random happening, at most 20 ms after the last, then a check.
  void step() {
    move_clock();
    if (adversary_.one_in(5)) jacket_.status.telemetry = adversary_.telemetry(now_);
    if (adversary_.one_in(40)) consent_ = adversary_.consent(wall_);
    if (adversary_.one_in(40)) now_min_ = adversary_.whole(0, minutes_of_day - 1);
    safety_.permit(permission_at(consent_, wall_, now_min_), now_);
    jacket_.status.heater_count = adversary_.one_in(20) ? 0 : 2;
    switch (adversary_.whole(0, 11)) {
      case 0:
        jacket_.next_state = static_cast<LinkState>(adversary_.whole(0, 2));
        break;
      case 1:
        jacket_.loses_frames = adversary_.one_in(4);
        break;
      case 2:
        jacket_.accepts_frames = !adversary_.one_in(4);
        break;
      case 3:
        stop();
        break;
      case 4:
        safety_.resume();
        break;
      case 5:
        if (adversary_.one_in(4)) safety_.all_off(adversary_.sender(), now_);
        if (adversary_.one_in(8)) forget();
        break;
      case 6:
        jacket_.next_state = LinkState::armed;
        break;
      case 7:
      case 8:
        heartbeat();
        break;
      default:
        apply();
        break;
    }
    safety_.tick(now_);
    check();
  }

  // The sender falls silent; everything is off 300 ms later, whatever it sent last.
  void sender_dies() {
    for (Duration passed{}; passed < 300ms; passed += 20ms) {
      now_ += 20ms;
      if (adversary_.one_in(2)) apply();
      safety_.tick(now_);
      check();
    }
    EXPECT_THAT(jacket_.running(now_), ::testing::IsEmpty());
    EXPECT_THAT(safety_.running(), ::testing::IsEmpty());
    for (std::size_t heater = 0; heater < 2; ++heater)
      EXPECT_EQ(jacket_.celsius(heater, now_), 0);
  }

  // The daemon is killed: nothing reaches the jacket any more.
  void daemon_freezes() {
    now_ += 250ms;
    check_frames();
    check_duty();
    EXPECT_THAT(jacket_.running(now_), ::testing::IsEmpty());
    for (std::size_t heater = 0; heater < 2; ++heater)
      EXPECT_EQ(jacket_.celsius(heater, now_), 0);
  }

  [[nodiscard]] bool drove() const {
    return std::ranges::any_of(jacket_.frames, [](const FakeJacket::Frame& frame) {
      return std::ranges::any_of(frame.commands, [](const MotorCommand& command) { return command.intensity > 0; });
    });
  }
  [[nodiscard]] bool heated() const {
    return std::ranges::any_of(jacket_.heat_frames, [](const FakeJacket::HeatFrame& frame) {
      return std::ranges::any_of(frame.commands, [](const HeaterCommand& command) { return command.celsius > 0; });
    });
  }
  [[nodiscard]] const SafetyCounters& counters() const { return safety_.counters(); }
  // An actuator that may be driven but for the box that it lies in was asked to be.
  [[nodiscard]] bool muted_a_box() const { return muted_a_box_; }

 private:
  void move_clock() {
    const Timestamp before = now_;
    now_ += std::chrono::milliseconds(adversary_.whole(0, 20));
    if (adversary_.one_in(40)) wall_ += std::chrono::seconds(adversary_.whole(-20, 20));
    if (!adversary_.one_in(200)) return;
    const Duration jump = std::chrono::milliseconds(adversary_.whole(-5000, 5000));
    now_ += jump;
    for (auto& motor : jacket_.motors)
      motor.end += jump;  // the microcontroller's own clock has not jumped
    for (auto& heater : jacket_.heaters)
      heater.end += jump;
    if (now_ >= before) return;
    heartbeats_.fill(Timestamp{});  // whatever was heard before says nothing now
    power_.forget();
  }

  void heartbeat() {
    const SenderNumber sender = adversary_.sender();
    if (sender < max_senders) heartbeats_.at(sender) = now_;
    safety_.on_heartbeat(sender, now_);
  }

  void forget() {
    check_frames();  // those of before were vouched for
    const SenderNumber sender = adversary_.sender();
    if (sender < max_senders) heartbeats_.at(sender) = Timestamp{};
    safety_.forget(sender, now_);
  }

  // No sender vouches for anything from then on.
  [[nodiscard]] Timestamp vouched_until() const { return std::ranges::max(heartbeats_) + limits_.heartbeat_timeout; }

  void stop() {
    if (!adversary_.one_in(4)) return;
    safety_.stop("test", now_);
    EXPECT_TRUE(safety_.stopped());
  }

  // Drives that no planner would make, or those that the planner makes of touches that nobody would send.
  void apply() {
    const SafetyVerdict verdict = safety_.apply(adversary_.sender(), some_drives(), now_);
    for (const std::uint8_t id : verdict.muted) {
      const Actuator& actuator = profile_.actuators.at(profile_.index_of(id).value());
      EXPECT_TRUE(silenced(actuator));
      muted_a_box_ = muted_a_box_ || (actuator.enabled && !safety_.permission().muted_actuators.test(id));
    }
    if (safety_.stopped()) {
      EXPECT_EQ(verdict.outcome, FeltOutcome::stopped);
    } else if (safety_.permission().refusal) {
      EXPECT_EQ(verdict.outcome, *safety_.permission().refusal);
    }
  }

  Drives some_drives() {
    if (adversary_.one_in(2)) return adversary_.drives(now_);
    if (adversary_.one_in(2)) return renderer_.tick(now_);
    const TouchEvent event = adversary_.event();
    return renderer_.plan(event, {event.transitions.data(), event.transitions.size()}, now_).drives;
  }

  void check_frames() {
    for (; checked_ < jacket_.frames.size(); ++checked_) {
      take_stops(checked_);
      check_frame(jacket_.frames[checked_]);
      power_.command(jacket_.frames[checked_]);
      check_current(jacket_.frames[checked_].time);
    }
    take_stops(checked_);
    for (; checked_heat_ < jacket_.heat_frames.size(); ++checked_heat_)
      check_heat(jacket_.heat_frames[checked_heat_]);
  }

  // Those that left after so many frames.
  void take_stops(std::size_t frames) {
    for (; taken_stops_ < jacket_.stop_log.size() && jacket_.stop_log[taken_stops_].after_frames <= frames;
         ++taken_stops_)
      power_.stop(jacket_.stop_log[taken_stops_].time);
  }

  void check_current(Timestamp time) {
    if (profile_.supply_ma <= 0) return;
    double total_ma = 0;
    for (std::size_t channel = 0; channel < by_channel_.size(); ++channel) {
      if (by_channel_.at(channel) != nullptr) {
        total_ma += power_.power(channel, time) * by_channel_.at(channel)->current_ma;
      }
    }
    EXPECT_LE(total_ma, profile_.supply_ma + 1e-6);
  }

  void check_duty() {
    for (std::size_t channel = 0; channel < by_channel_.size(); ++channel) {
      const Actuator* actuator = by_channel_.at(channel);
      if (actuator == nullptr) continue;
      const double window_s = std::chrono::duration<double>(profile_.duty_window).count();
      EXPECT_LE(power_.used_s(channel, profile_.duty_window, now_),
                actuator->max_duty * window_s * actuator->max_strength + 1e-6);
    }
  }

  [[nodiscard]] bool silenced(const Actuator& actuator) const {
    return !actuator.enabled || safety_.permission().muted_actuators.test(actuator.id) || in_muted_box(actuator);
  }
  [[nodiscard]] bool in_muted_box(const Actuator& actuator) const {
    for (int box = 1; box <= 20; ++box) {
      const BodyPoint middle = middle_of(box);
      const bool inside =
          std::abs(actuator.place.x_fh - middle.x_fh) < 0.25 && std::abs(actuator.place.y_fh - middle.y_fh) < 0.25;
      if (inside && safety_.permission().muted_boxes.test(static_cast<std::size_t>(box))) return true;
    }
    return false;
  }

  void check_heat(const FakeJacket::HeatFrame& frame) {
    for (const HeaterCommand& command : frame.commands) {
      ASSERT_LT(command.heater, 2);
      EXPECT_GE(command.duration, 0ms);
      EXPECT_LE(command.duration, 250ms);
      EXPECT_LE(command.duration, limits_.longest_drive);
      if (command.celsius == 0) continue;
      const Actuator& actuator = profile_.actuators.at(8U + command.heater);
      EXPECT_GE(command.celsius, least_celsius);
      EXPECT_LE(command.celsius, std::min({40.0, actuator.max_celsius, limits_.max_celsius}));
      EXPECT_LE(frame.time + command.duration, vouched_until());
      EXPECT_FALSE(safety_.stopped());
      EXPECT_FALSE(safety_.permission().refusal);
      EXPECT_FALSE(silenced(actuator));
      const auto& telemetry = jacket_.status.telemetry;
      ASSERT_TRUE(telemetry);
      EXPECT_LE(frame.time - telemetry->heard, 2s);
      ASSERT_LT(command.heater, telemetry->heaters.size());
      const auto& told = telemetry->heaters[command.heater];
      EXPECT_EQ(told.fault, protocol::HeaterFault::none);
      ASSERT_TRUE(told.celsius);
      EXPECT_LT(*told.celsius, 41);
    }
  }

  void check() {
    check_frames();
    check_duty();
    for (const std::uint8_t id : safety_.running()) {
      EXPECT_FALSE(safety_.stopped()) << "actuator " << int{id};
      EXPECT_FALSE(safety_.permission().refusal);
      EXPECT_EQ(jacket_.status.state, LinkState::armed);
      EXPECT_LT(now_, vouched_until());
    }
  }

  void check_frame(const FakeJacket::Frame& frame) {
    std::array<bool, 16> seen{};
    for (const MotorCommand& command : frame.commands) {
      ASSERT_LT(command.channel, 16);
      EXPECT_FALSE(seen.at(command.channel)) << "a channel is commanded twice in one frame";
      seen.at(command.channel) = true;
      EXPECT_LE(power_at_pin(command.intensity), most_.at(command.channel) + 1e-6)
          << "channel " << int{command.channel};
      EXPECT_GE(command.duration, 0ms);
      EXPECT_LE(command.duration, 250ms);
      EXPECT_LE(command.duration, limits_.longest_drive);
      if (command.intensity == 0) continue;
      EXPECT_GT(command.duration, 0ms);
      EXPECT_LE(frame.time + command.duration, vouched_until()) << "outlives what the senders' heartbeats vouch for";
      EXPECT_FALSE(safety_.stopped());
      EXPECT_FALSE(safety_.permission().refusal);
      EXPECT_FALSE(silenced(*by_channel_.at(command.channel)));
    }
  }

  Adversary adversary_;
  FakeJacket jacket_;
  JacketProfile profile_;
  SafetyLimits limits_;
  SafetyStage safety_;
  JacketRenderer renderer_{profile_, std::chrono::milliseconds(adversary_.whole(-10, 1000))};
  Consent consent_;
  std::chrono::sys_seconds wall_{std::chrono::hours(500'000)};
  int now_min_ = 0;
  PowerLog power_;
  std::array<const Actuator*, 16> by_channel_{};
  std::array<double, 16> most_{};
  Timestamp now_ = from_ns(100'000'000'000);
  std::array<Timestamp, max_senders> heartbeats_{};
  std::size_t checked_ = 0;
  std::size_t checked_heat_ = 0;
  std::size_t taken_stops_ = 0;
  bool muted_a_box_ = false;
};

TEST(SafetyStageWithAnyInput, stays_within_every_limit_and_is_off_when_the_sender_dies) {
  int drove = 0;
  int heated = 0;
  int tired = 0;
  int short_of_current = 0;
  int muted_boxes = 0;
  for (std::uint32_t seed = 1; seed <= 1500; ++seed) {
    SCOPED_TRACE(seed);
    HauntedJacket haunted(seed);
    for (int step = 0; step < 400; ++step)
      haunted.step();
    haunted.sender_dies();
    if (::testing::Test::HasFailure()) return;
    drove += haunted.drove() ? 1 : 0;
    heated += haunted.heated() ? 1 : 0;
    tired += haunted.counters().limited_by_duty > 0 ? 1 : 0;
    short_of_current += haunted.counters().limited_by_current > 0 ? 1 : 0;
    muted_boxes += haunted.muted_a_box() ? 1 : 0;
  }
  // It has been tried, not just avoided.
  EXPECT_GT(drove, 1000);
  EXPECT_GT(heated, 300);
  EXPECT_GT(tired, 300);
  EXPECT_GT(short_of_current, 200);
  EXPECT_GT(muted_boxes, 300);
}

TEST(SafetyStageWithAnyInput, leaves_a_jacket_that_is_silent_250_ms_after_the_daemon_dies) {
  for (std::uint32_t seed = 10001; seed <= 11500; ++seed) {
    SCOPED_TRACE(seed);
    HauntedJacket haunted(seed);
    for (int step = 0; step < 200; ++step)
      haunted.step();
    haunted.daemon_freezes();
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace telehug
