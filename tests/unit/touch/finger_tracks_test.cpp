// SPDX-License-Identifier: Apache-2.0
//
// Several fingers, crossings, dropouts, disturbed scenes: what a contact's identity survives.
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "doubles/allocation_counter.hpp"
#include "doubles/contact_score.hpp"

namespace telehug {
namespace {

constexpr double frame_s = 1.0 / 30;
const CameraFoot camera{{200, -10}, 45, 300};

ContactTracker tracker() {
  TrackerOptions options;
  options.camera = camera;
  return ContactTracker(options);
}

// A finger at (x, y) and height z, as the camera reads it.
FingerObservation seen_at(double x_mm, double y_mm, double z_mm = 0, MirrorState mirror = MirrorState::unknown) {
  const double nearer = camera.height_mm / (camera.height_mm - z_mm);
  return {
      {camera.foot.x_mm + nearer * (x_mm - camera.foot.x_mm), camera.foot.y_mm + nearer * (y_mm - camera.foot.y_mm)},
      15 * nearer,
      1000 / (y_mm - camera.foot.y_mm),
      {mirror, z_mm, 2.3},
      1};
}

// Comes down within four frames.
double height_before(int frames) {
  return 35 * std::pow(frames / 4.0, 1.4);
}

struct Played {
  std::vector<ContactStates> frames;
  int downs = 0;
  int ups = 0;
};

template <typename Frame>
Played play(ContactTracker& tracker, int first, int last, const Frame& frame) {
  Played played;
  for (int i = first; i < last; ++i) {
    const auto [fingers, scene] = frame(i);
    played.frames.push_back(tracker.update(fingers, simulated_time(i * frame_s), scene));
    for (const ContactState& state : played.frames.back()) {
      played.downs += state.phase == Phase::down ? 1 : 0;
      played.ups += state.phase == Phase::up ? 1 : 0;
    }
  }
  return played;
}

using Fingers = std::pair<FingerObservations, Scene>;

// Lands at (x, y) in frame 0 and rests there until frame 10.
std::optional<FingerObservation> lands(int frame, double x_mm, double y_mm) {
  if (frame < -2) return std::nullopt;
  return seen_at(x_mm, y_mm, frame < 0 ? height_before(-frame) : 0);
}

TEST(FingerTracks, KeepTheirIdentitiesThroughACrossing) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 0.5);
  int swapped = 0;
  constexpr int crossings = 300;
  for (int n = 0; n < crossings; ++n) {
    ContactTracker fingers = tracker();
    std::uniform_real_distribution<double> between(0, 1);
    const double speed_mm = 8 + 12 * between(random), apart_mm = 12 * between(random), phase = between(random);
    std::map<bool, std::uint32_t> id_of;
    const auto played = play(fingers, -4, 30, [&](int i) {
      Fingers frame;
      const double along = std::clamp(i - 8, 0, 14) * speed_mm + phase * speed_mm;
      for (const bool left : {true, false}) {
        const double x = left ? 80 + along : 80 + 15 * speed_mm - along;
        if (auto finger = lands(i, x + noise(random), (left ? 180 : 180 + apart_mm) + noise(random)))
          frame.first.push_back(*finger);
      }
      if (n % 2 == 0) std::ranges::reverse(frame.first);
      return frame;
    });
    const auto leftmost = [](const ContactStates& states) {
      return std::ranges::min(states, {}, [](const ContactState& state) { return state.screen.x_mm; }).id;
    };
    ASSERT_EQ(played.frames[11].size(), 2U);
    if (played.frames.back().size() != 2 || leftmost(played.frames[11]) == leftmost(played.frames.back())) ++swapped;
  }
  EXPECT_LE(swapped, crossings / 100);
}

TEST(FingerTracks, TakeUpAContactThatWasNotSeenInAFrame) {
  ContactTracker fingers = tracker();
  const auto played = play(fingers, -4, 20, [](int i) {
    Fingers frame;
    if (i != 8 && i != 13) {
      if (auto finger = lands(i, 150, 150)) frame.first.push_back(*finger);
    }
    return frame;
  });
  EXPECT_EQ(played.downs, 1);
  EXPECT_EQ(played.ups, 0);
  EXPECT_EQ(played.frames[12][0].phase, Phase::move);
  EXPECT_EQ(played.frames[12][0].frame_time, simulated_time(7 * frame_s));
}

TEST(FingerTracks, DoubtAContactThatALiftWouldHide) {
  ContactTracker fingers = tracker();
  const auto played = play(fingers, -4, 9, [](int i) {
    Fingers frame;
    const auto finger = lands(i, 150, 280);  // 3 mm up it does not cross the border any more
    if (finger && i < 7) frame.first.push_back(*finger);
    return frame;
  });
  EXPECT_EQ(played.downs, 1);
  ASSERT_EQ(played.frames[11].size(), 1U);
  EXPECT_EQ(played.frames[11][0].phase, Phase::move) << "it may come back";
  EXPECT_LT(played.frames[11][0].touching, 0.5);
  EXPECT_EQ(played.frames[12][0].phase, Phase::up);
}

TEST(FingerTracks, BeginAndEndNothingInADisturbedScene) {
  ContactTracker fingers = tracker();
  const auto played = play(fingers, -4, 20, [](int i) {
    Fingers frame{{}, i >= 6 && i < 10 ? Scene::disturbed : Scene::steady};
    if (i < 6 || i >= 10) {
      frame.first.push_back(seen_at(150, 150, i < 0 ? height_before(-i) : 0));
    } else {
      frame.first.push_back(seen_at(300, 100, 0, MirrorState::touching));  // what the flash looks like
    }
    return frame;
  });
  EXPECT_EQ(played.downs, 1);
  EXPECT_EQ(played.ups, 0);
}

TEST(FingerTracks, EndAContactThatIsGoneForLongInADisturbedScene) {
  ContactTracker fingers = tracker();
  const auto played = play(fingers, -4, 30, [](int i) {
    Fingers frame{{}, i >= 6 ? Scene::disturbed : Scene::steady};
    if (i < 6) frame.first.push_back(seen_at(150, 150, i < 0 ? height_before(-i) : 0));
    return frame;
  });
  EXPECT_EQ(played.downs, 1);
  EXPECT_EQ(played.ups, 1);
}

TEST(FingerTracks, TouchWhenTheyAppearBesideTheEdgeIfTheMirrorIsSure) {
  for (const auto& [y_mm, log_ratio, downs] :
       {std::tuple{290, 4.0, 1}, {290, 1.5, 0}, {200, 4.0, 0}}) {  // the edge is at 300 mm
    ContactTracker fingers = tracker();
    const auto played = play(fingers, -2, 1, [y_mm = y_mm, log_ratio = log_ratio](int i) {
      Fingers frame{{}, Scene::steady};
      if (i < 0) return frame;
      frame.first.push_back(seen_at(150, y_mm, 0, MirrorState::touching));
      frame.first.back().mirror.log_ratio = log_ratio;
      return frame;
    });
    EXPECT_EQ(played.downs, downs) << y_mm << " mm, " << log_ratio;
  }
}

// While no pictures came it may have come from anywhere and landed or not.
TEST(FingerTracks, DoNotTouchJustBecauseNothingWasSeenForLong) {
  ContactTracker fingers = tracker();
  fingers.update({}, simulated_time(0));
  FingerObservation finger = seen_at(150, 290, 0, MirrorState::touching);
  finger.mirror.log_ratio = 1.5;
  EXPECT_TRUE(fingers.update({finger}, simulated_time(1)).empty());
}

// A flashing screen makes detectors see fingers where there are none, here and there, with any evidence. Of five such
// frames four are known to be disturbed.
TEST(FingerTracks, TakeNoFlashForATouch) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> between(0, 1);
  ContactTracker fingers = tracker();
  const auto played = play(fingers, 0, 9000, [&](int) {
    Fingers frame;
    if (between(random) < 0.3) {
      frame.first.push_back(seen_at(400 * between(random), 60 + 240 * between(random), 0,
                                    static_cast<MirrorState>(static_cast<int>(3 * between(random)))));
      frame.first.back().mirror.log_ratio = 4 * between(random);
      frame.second = between(random) < 0.8 ? Scene::disturbed : Scene::steady;
    }
    return frame;
  });
  EXPECT_LE(played.downs, 6) << "in 5 minutes with 540 that are not known";
}

TEST(FingerTracks, ReportFingersThatHover) {
  ContactTracker fingers = tracker();
  const auto played = play(fingers, 0, 5, [](int) {
    return Fingers{{seen_at(150, 150, 15, MirrorState::hovering)}, Scene::steady};
  });
  EXPECT_EQ(played.downs, 0);
  ASSERT_EQ(fingers.hovering().size(), 1U);
  EXPECT_NEAR(fingers.hovering()[0].screen.y_mm, seen_at(150, 150, 15).screen.y_mm, 1e-9);
  EXPECT_LT(fingers.hovering()[0].touching, 0.1);
  EXPECT_EQ(fingers.hovering()[0].since, simulated_time(0));
}

TEST(FingerTracks, ReportSinceWhenALiftedFingerHovers) {
  ContactTracker fingers = tracker();
  int lifted = 0;
  play(fingers, -3, 25, [&](int i) {
    if (i < 10) {
      const auto finger = lands(i, 150, 150);
      return Fingers{finger ? FingerObservations{*finger} : FingerObservations{}, Scene::steady};
    }
    for (const HoveringFinger& finger : fingers.hovering())
      if (lifted == 0 && finger.since > simulated_time(8 * frame_s)) lifted = i - 1;
    return Fingers{{seen_at(150, 150, std::min(20.0, 5.0 * (i - 9)), MirrorState::hovering)}, Scene::steady};
  });
  ASSERT_EQ(fingers.hovering().size(), 1U);
  EXPECT_GE(lifted, 10);
  EXPECT_LE(fingers.hovering()[0].since, simulated_time(lifted * frame_s));
  EXPECT_GE(fingers.hovering()[0].since, simulated_time(10 * frame_s)) << "not since it was first seen";
}

TEST(FingerTracks, KeepTheirPromisesWhateverIsSeen) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> between(0, 1);
  ContactTracker fingers = tracker();
  std::set<std::uint32_t> alive, ended;
  double t = 0;
  for (int i = 0; i < 20000; ++i) {
    FingerObservations seen;
    for (int n = static_cast<int>(11 * between(random)); n > 0; --n) {
      FingerObservation finger = seen_at(400 * between(random), 300 * between(random), 0,
                                         static_cast<MirrorState>(static_cast<int>(3 * between(random))));
      if (between(random) < 0.1) finger.width_mm = 0;
      if (between(random) < 0.1) finger.screen = {-1e6 * between(random), 1e6 * between(random)};
      if (between(random) < 0.1) finger.quality = 0;
      seen.push_back(finger);
    }
    t += between(random) < 0.01 ? 0 : 0.05 * between(random);
    const Scene scene = between(random) < 0.1 ? Scene::disturbed : Scene::steady;
    const auto allocated = allocation_count();
    const ContactStates& states = fingers.update(seen, simulated_time(t), scene);
    ASSERT_EQ(allocation_count(), allocated);
    std::set<std::uint32_t> reported;
    for (const ContactState& state : states) {
      ASSERT_TRUE(reported.insert(state.id).second) << "an id twice in a frame";
      ASSERT_FALSE(ended.contains(state.id)) << "an id after its up";
      ASSERT_EQ(alive.contains(state.id), state.phase != Phase::down);
      ASSERT_TRUE(std::isfinite(state.screen.x_mm) && std::isfinite(state.speed_mm_s));
      ASSERT_TRUE(state.touching >= 0 && state.touching <= 1) << state.touching;
      if (state.phase == Phase::up) {
        alive.erase(state.id);
        ended.insert(state.id);
      } else {
        alive.insert(state.id);
      }
    }
    for (const auto id : alive)
      ASSERT_TRUE(reported.contains(id)) << "a contact that lives was not reported";
  }
  EXPECT_GT(ended.size(), 100U);
}

}  // namespace
}  // namespace telehug
