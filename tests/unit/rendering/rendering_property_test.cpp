// SPDX-License-Identifier: Apache-2.0
//
// Whatever is sent, in whatever order and at whatever times: what the renderer asks for is possible, allowed and ends.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "unit/rendering/rendering_builders.hpp"

namespace telehug {
namespace {

class Haunted {
 public:
  explicit Haunted(std::uint32_t seed) : random_(seed), profile_(random_profile()) {}

  void step() {
    now_ += std::chrono::milliseconds(one_in(30) ? whole(-500, 2000) : whole(0, 15));
    if (one_in(3)) {
      const TouchEvent event = random_event();
      const JacketPlan& plan = renderer_.plan(event, {event.transitions.data(), event.transitions.size()}, now_);
      last_event_ = now_;
      for (const ContactAnswer& answer : plan.answers) {
        EXPECT_EQ(answer.actuators.empty(), answer.outcome != FeltOutcome::driven);
        for (const std::uint8_t id : answer.actuators)
          check_id(id, false);
      }
      check(plan.drives);
    } else {
      check(renderer_.tick(now_));
    }
  }

 private:
  int whole(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
  double real(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }
  bool one_in(int n) { return whole(1, n) == 1; }
  double odd(double usual) {
    static constexpr double odds[]{std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity(),
                                   -1e300,
                                   1e300,
                                   1e-300,
                                   0};
    return one_in(12) ? odds[whole(0, 6)] : usual;
  }

  JacketProfile random_profile() {
    JacketProfile profile = places_of({}, one_in(2) ? Uncovered::nearest : Uncovered::none);
    if (one_in(5)) profile.rendering = Rendering::boxes;
    for (int id = whole(1, static_cast<int>(max_actuators)); id > 0; --id) {
      Actuator made = motor(static_cast<std::uint8_t>(id), {real(-1, 1), real(0, 2)}, {});
      if (one_in(3)) made.place = {whole(-2, 2) * 0.5, whole(0, 3) * 0.5};
      made.kind = one_in(8) ? ActuatorKind::heater : ActuatorKind::motor;
      made.side = one_in(4) ? BodySide::back : BodySide::front;
      made.boxes = {static_cast<std::uint16_t>(whole(1, 20))};
      made.enabled = !one_in(8);
      made.gamma = real(0.2, 5);
      made.kick = std::chrono::milliseconds(whole(0, 100));
      profile.actuators.push_back(made);
    }
    return profile;
  }

  Contact random_contact() {
    Contact made = contact_in(whole(1, 20), static_cast<std::uint32_t>(whole(1, 5)), static_cast<Phase>(whole(0, 2)));
    made.body = {odd(real(-2, 2)), odd(real(-1, 3))};
    made.strength = odd(real(-0.2, 1.2));
    made.speed_mm_s = odd(real(0, 3000));
    made.gesture = static_cast<Gesture>(whole(0, gesture_count - 1));
    return made;
  }

  TouchEvent random_event() {
    TouchEvent made;
    made.sequence = static_cast<std::uint64_t>(whole(0, 5));
    made.frame_time_ns = whole(0, 1'000'000'000);
    for (int n = whole(0, one_in(5) ? static_cast<int>(max_contacts) : 2); n > 0; --n)
      made.contacts.push_back(random_contact());
    for (int n = whole(0, one_in(5) ? static_cast<int>(max_transitions) : 1); n > 0; --n)
      made.transitions.push_back({static_cast<std::uint64_t>(whole(0, 5)), whole(0, 1'000'000'000), random_contact()});
    return made;
  }

  void check_id(std::uint8_t id, bool may_be_heater) {
    const auto index = profile_.index_of(id);
    ASSERT_TRUE(index);
    EXPECT_TRUE(profile_.actuators[*index].enabled);
    EXPECT_TRUE(may_be_heater || profile_.actuators[*index].kind == ActuatorKind::motor);
  }

  void check(const Drives& drives) {
    std::set<std::uint8_t> seen;
    for (const Drive& drive : drives) {
      EXPECT_TRUE(seen.insert(drive.actuator).second) << "told twice";
      check_id(drive.actuator, true);
      EXPECT_TRUE(drive.strength >= 0 && drive.strength <= 1) << drive.strength;
      EXPECT_LE(drive.end, std::min(last_event_, now_) + hold_);
      EXPECT_TRUE(drive.strength == 0 || drive.end > now_);
    }
    if (now_ < last_event_) last_event_ = Timestamp{};  // the clock has gone back: nothing is vouched for
  }

  std::mt19937 random_;
  JacketProfile profile_;
  Duration hold_ = std::chrono::milliseconds(whole(1, 250));
  JacketRenderer renderer_{profile_, hold_};
  Timestamp now_ = from_ns(100'000'000'000);
  Timestamp last_event_;
};

TEST(RenderingOfAnyInput, stays_within_what_is_possible_and_ends) {
  for (std::uint32_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    Haunted haunted(seed);
    for (int step = 0; step < 600; ++step)
      haunted.step();
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace telehug
