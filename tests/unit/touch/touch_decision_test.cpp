// SPDX-License-Identifier: Apache-2.0
//
// Touch or hover, of thousands of simulated gestures: how late, how often wrong. Run it to see the table.
#include <gtest/gtest.h>

#include <iomanip>
#include <iostream>
#include <string>

#include "doubles/simulated_touches.hpp"

namespace telehug {
namespace {

constexpr unsigned people = 500;

struct View {
  const char* name;
  double frames_per_s;
  bool mirror;    // does the screen show the finger's mirror image? 5 % of its verdicts are wrong
  double faults;  // share of frames in which the finger is not found
};

class TouchDecision : public testing::TestWithParam<View> {
 protected:
  static ContactScore of(Gestures gestures, bool known_people = false) {
    SimulatedSight sight;
    sight.frames_per_s = GetParam().frames_per_s;
    sight.mirror = GetParam().mirror;
    sight.dropouts = GetParam().faults;
    const ContactScore score = simulate_touches(gestures, sight, people, known_people);
    print(score);
    return score;
  }

  // Frames that make 33 ms.
  static int a_frame_at_30_hz() { return GetParam().frames_per_s > 45 ? 2 : 1; }

 private:
  static void print(const ContactScore& score) {
    const auto percent = [](double share) { return 100 * share; };
    const int late = a_frame_at_30_hz();
    std::cout << std::fixed << std::setprecision(1);
    if (score.contacts > 0) {
      std::cout << "  " << score.contacts << " contacts: down within 33 ms "
                << percent(ContactScore::within(score.down_late_frames, late)) << " %, up "
                << percent(ContactScore::within(score.up_late_frames, late)) << " %, missed " << score.missed
                << ", more than one id " << score.split << "\n";
    }
    std::cout << "  downs without a contact " << score.spurious << "; " << score.hovers_touched << " of "
              << score.hovers << " hovering gestures touch; taken for touch of frames at 5-10, 10-15, 15-20, 20-60 mm:";
    for (std::size_t bin = 0; bin < score.hovering_frames.size(); ++bin)
      std::cout << " " << percent(ContactScore::share(score.hovering_touched[bin], score.hovering_frames[bin]));
    std::cout << " %, from 10 mm on " << std::setprecision(2) << percent(score.hovering_share(1)) << " %\n";
  }
};

std::string view_name(const testing::TestParamInfo<View>& view) {
  return view.param.name;
}

INSTANTIATE_TEST_SUITE_P(At, TouchDecision,
                         testing::Values(View{"30HzMatt", 30, false, 0}, View{"30HzMattWithDropouts", 30, false, 0.01},
                                         View{"30HzMirror", 30, true, 0.01}, View{"60HzMatt", 60, false, 0},
                                         View{"60HzMirror", 60, true, 0.01}),
                         view_name);

TEST_P(TouchDecision, IsMadeWithinAFrameOfTheTruth) {
  const double seen = GetParam().mirror ? 0.93 : 0.8;
  for (const Gestures gestures : {Gestures::taps, Gestures::strokes}) {
    const ContactScore score = of(gestures);
    EXPECT_GE(ContactScore::within(score.down_late_frames, a_frame_at_30_hz()), seen);
    EXPECT_GE(ContactScore::within(score.up_late_frames, a_frame_at_30_hz()), 0.88);
    EXPECT_LE(ContactScore::share(score.missed, score.contacts), GetParam().mirror ? 0.005 : 0.07);
  }
}

TEST_P(TouchDecision, IsSurerOfPeopleWhoseFingersAreKnown) {
  const ContactScore taps = of(Gestures::taps, true);
  EXPECT_LE(ContactScore::share(taps.missed, taps.contacts), GetParam().mirror ? 0.005 : 0.04);
  EXPECT_LE(of(Gestures::hovers, true).hovering_share(1), 0.01);
}

TEST_P(TouchDecision, DoesNotFlicker) {
  for (const Gestures gestures : {Gestures::taps, Gestures::strokes}) {
    const ContactScore score = of(gestures);
    EXPECT_LE(ContactScore::share(score.split, score.contacts), 0.05);
    EXPECT_LE(ContactScore::share(score.spurious, score.contacts), 0.01);
  }
}

TEST_P(TouchDecision, TakesAHandThatPassesAt10MillimetresAndMoreForNoTouch) {
  for (const Gestures gestures : {Gestures::taps, Gestures::strokes})
    EXPECT_LE(of(gestures).hovering_share(1), 0.002);
}

TEST_P(TouchDecision, TakesAHandThatWaitsAt10MillimetresAndMoreForNoTouch) {
  EXPECT_LE(of(Gestures::hovers).hovering_share(1), GetParam().mirror ? 0.002 : 0.03) << "of somebody unknown";
  EXPECT_LE(of(Gestures::touches_then_a_hover).hovering_share(1), GetParam().mirror ? 0.001 : 0.01)
      << "of somebody who has touched";
}

}  // namespace
}  // namespace telehug
