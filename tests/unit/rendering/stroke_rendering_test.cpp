// SPDX-License-Identifier: Apache-2.0
//
// A stroke across the picture is one movement on the body, whatever its speed and however many events are lost.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "rendering/geometry.hpp"
#include "rendering/jacket_renderer.hpp"
#include "unit/rendering/rendering_builders.hpp"

namespace telehug {
namespace {

using ::testing::IsEmpty;

class StrokeRendering : public ::testing::Test {
 protected:
  StrokeRendering() {
    jacket.watch = [this] { note(); };
  }

  struct Run {
    Timestamp from;
    Timestamp to;
  };

  // A finger goes from..to at this speed, with so many events a second, and is lifted there. `comes`: whether the n-th
  // event arrives.
  void stroke(
      double from_fh, double to_fh, double speed_fh_s, int events_s,
      const std::function<bool(int)>& comes = [](int) { return true; }) {
    const Duration interval = std::chrono::nanoseconds(1'000'000'000 / events_s);
    const int steps = static_cast<int>(std::ceil((to_fh - from_fh) / speed_fh_s * events_s));
    for (int n = 0; n <= steps; ++n) {
      if (n > 0) pass(interval);
      const Phase phase = n == 0 ? Phase::down : n == steps ? Phase::up : Phase::move;
      finger_fh = std::min(to_fh, from_fh + speed_fh_s * n / events_s);
      Contact contact = contact_at({finger_fh, 1}, n < 2 ? Gesture::none : Gesture::stroke, phase);
      contact.speed_mm_s = n == steps ? 0 : speed_fh_s * 130;  // a finger that is gone has none
      contact.strength = strength;
      if (comes(n)) jacket.feel(contact);
      note();
    }
    // The sender repeats for a while what has ended.
    for (int n = 0; n < 8; ++n) {
      pass(interval);
      jacket.feel(std::vector<Contact>{});
      note();
    }
    pass(180ms);
  }

  // In steps that are no multiple of the drive thread's round.
  void pass(Duration time) {
    while (time > ObedientJacket::round) {
      jacket.pass(ObedientJacket::round);
      time -= ObedientJacket::round;
    }
    jacket.now += time;
  }

  void note() {
    for (std::uint8_t id = 1; id <= 5; ++id) {
      const bool on = jacket.strength(id) > 0.2;
      if (on && !runs[id].from.time_since_epoch().count()) runs[id].from = jacket.now;
      if (on) runs[id].to = jacket.now;
      strongest[id] = std::max(strongest[id], jacket.strength(id));
    }
  }

  ObedientJacket jacket{places_of(row_of_motors())};
  double strength = 1;
  double finger_fh = 0;
  std::map<std::uint8_t, Run> runs;
  std::map<std::uint8_t, double> strongest;
};

TEST_F(StrokeRendering, is_felt_where_the_finger_is_with_the_same_energy_all_the_way) {
  jacket.feel(contact_at({-1, 1}));
  double strongest_jump = 0;
  double before = -1;
  for (int n = 1; n < 150; ++n) {
    pass(33ms);
    finger_fh = -1 + 2 * n / 150.0;  // 0.4 fh/s: 6 cm/s on a child
    jacket.feel(contact_at({finger_fh, 1}, Gesture::stroke, Phase::move));
    double energy = 0;
    double centre_fh = 0;
    for (std::uint8_t id = 1; id <= 5; ++id) {
      const double own = jacket.strength(id) * jacket.strength(id);
      energy += own;
      centre_fh += own * ((id - 3) * 0.5);
    }
    centre_fh /= energy;
    EXPECT_NEAR(centre_fh, finger_fh, 0.02);
    if (n > 10) {
      EXPECT_NEAR(std::sqrt(energy), stroke_level(0), 0.03);
    }
    strongest_jump = std::max(strongest_jump, centre_fh - before);
    before = centre_fh;
  }
  EXPECT_LT(strongest_jump, 0.05);
}

TEST_F(StrokeRendering, that_is_fast_gives_each_motor_a_burst_as_far_apart_as_apparent_motion_asks_for) {
  stroke(-1.2, 1.2, 0.5 / 0.0793, 60);
  for (std::uint8_t id = 1; id <= 5; ++id) {
    ASSERT_GT(strongest[id], 0.3) << int{id};
    EXPECT_GE(runs[id].to - runs[id].from, burst - 10ms) << int{id};
    if (id > 2) {
      EXPECT_NEAR(to_ms(runs[id].from - runs[id - 1].from), to_ms(burst_distance), 25) << int{id};
    }
    if (id > 1) {
      EXPECT_LT(runs[id].from, runs[id - 1].to) << "no hole between them";
    }
  }
}

TEST_F(StrokeRendering, that_is_too_fast_for_motors_passes_each_of_them_in_turn_and_ends_in_time) {
  stroke(-1.2, 1.2, 24, 60);  // in a tenth of a second
  for (std::uint8_t id = 1; id <= 5; ++id) {
    ASSERT_GT(strongest[id], 0.3) << int{id};
    EXPECT_GE(runs[id].to - runs[id].from, burst - 20ms) << int{id};
    if (id > 1) {
      EXPECT_GT(runs[id].from, runs[id - 1].from) << int{id};
    }
  }
  EXPECT_GT(strongest[5], 0.55) << "as firm as a fast stroke is, though the finger is gone";
  EXPECT_GT(runs[5].from - runs[1].from, 150ms) << "slower than the finger, so that it is felt as a movement";
  EXPECT_LT(runs[5].to - ObedientJacket::start, 100ms + longest_lag + burst + 20ms);
}

TEST_F(StrokeRendering, that_is_weak_gives_weak_bursts_after_a_strong_one) {
  stroke(-1.2, 1.2, 6, 60);
  for (int n = 0; n < 30; ++n) {  // the sender goes on without a pause
    jacket.feel(std::vector<Contact>{});
    pass(30ms);
  }
  strongest.clear();
  strength = 0.3;
  stroke(-1.2, 1.2, 6, 60);
  for (std::uint8_t id = 1; id <= 5; ++id)
    EXPECT_LE(strongest[id], 0.3) << int{id};
}

TEST_F(StrokeRendering, has_no_hole_where_events_were_lost) {
  stroke(-1.2, 1.2, 6, 60, [](int n) { return n < 4 || n > 13; });  // 150 ms
  for (std::uint8_t id = 1; id <= 5; ++id) {
    ASSERT_GT(strongest[id], 0.2) << int{id};
    if (id > 1) {
      EXPECT_GE(runs[id].from, runs[id - 1].from) << int{id};
    }
  }
}

TEST_F(StrokeRendering, of_which_only_begin_and_end_arrive_is_felt_all_the_way) {
  const Contact down = contact_at({-1, 1});
  const Contact up = contact_at({1, 1}, Gesture::stroke, Phase::up);
  jacket.feel(std::vector<Contact>{}, {transition_of(0, down), transition_of(1, up)});
  note();
  for (int n = 0; n < 12; ++n) {
    pass(30ms);
    jacket.feel(std::vector<Contact>{});
    note();
  }
  for (std::uint8_t id = 2; id <= 5; ++id) {
    ASSERT_GT(strongest[id], 0.3) << int{id};
    EXPECT_GT(runs[id].from, runs[id - 1].from);
  }
  EXPECT_THAT(jacket.running(), IsEmpty());
}

TEST_F(StrokeRendering, whose_begin_was_lost_is_felt_from_there) {
  jacket.feel({contact_at({0.5, 1}, Gesture::stroke, Phase::move)}, {transition_of(0, contact_at({-0.5, 1}))});
  pass(150ms);
  note();
  EXPECT_GT(strongest[3], 0.3) << "between the two";
}

TEST_F(StrokeRendering, is_off_as_soon_as_no_event_comes_any_more) {
  jacket.feel(contact_at({-1, 1}));
  jacket.pass(20ms);
  jacket.feel(contact_at({1, 1}, Gesture::stroke, Phase::move));
  const Timestamp last = jacket.now;
  jacket.watch = [&] {
    for (const auto& [id, drive] : jacket.told)
      EXPECT_LE(drive.end, last + ObedientJacket::hold);
  };
  jacket.pass(ObedientJacket::hold);
  EXPECT_THAT(jacket.running(), IsEmpty());
}

TEST_F(StrokeRendering, ends_with_the_finger_when_that_was_slow) {
  stroke(-1.2, 0.1, 0.5, 30);
  EXPECT_EQ(runs.count(5), 0U);
  jacket.feel(contact_at({0, 1}));
  jacket.rest(contact_at({0, 1}, Gesture::stroke), 300ms);
  for (int n = 0; n < 30; ++n) {  // a place that is unsure, beside a motor
    jacket.pass(10ms);
    jacket.feel(contact_at({n % 2 * 0.03 - 0.015, 1}, Gesture::stroke, Phase::move));
  }
  jacket.feel(contact_at({0, 1}, Gesture::stroke, Phase::up));
  EXPECT_THAT(jacket.running(), IsEmpty());
}

}  // namespace
}  // namespace telehug
