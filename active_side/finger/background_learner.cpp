// SPDX-License-Identifier: Apache-2.0
#include "finger/background_learner.hpp"

#include <algorithm>

namespace telehug {
namespace {

// Shares of the strip that look as always. Two hands and their shadows leave more of it as it was than a light that
// comes from elsewhere; one that only becomes brighter is levelled out before.
constexpr double disturbed_below = 0.3;
constexpr double calm_above = 0.45;
// Automatic exposures settle within a second. What looks like a finger meanwhile may be one: it is waited for, but not
// for long, because without a background everything may look like one.
constexpr Duration relearn_after_quiet = 1s;
constexpr Duration relearn_at_last = 5s;

// A strip is learnt while nothing moves in it: the edges of a hand that moves change more.
constexpr double still_above = 0.98;
constexpr Duration still_for = 500ms;
constexpr int least_frames = 5;

}  // namespace

BackgroundLearner::BackgroundLearner(const BorderStrip::Layout& layout, bool known)
    : known_(known),
      had_background_(known),
      candidate_(layout, BorderStrip(layout)),
      no_finger_(static_cast<std::size_t>(layout.columns), false) {}

void BackgroundLearner::update(BackgroundStrip& background, const BorderStrip& strip,
                               const std::vector<bool>& is_finger, Timestamp now) {
  known_ ? watch(background, strip, is_finger, now) : learn(background, strip, now);
}

void BackgroundLearner::watch(BackgroundStrip& background, const BorderStrip& strip, const std::vector<bool>& is_finger,
                              Timestamp now) {
  if (background.unchanged_share() >= (disturbed_since_ ? calm_above : disturbed_below)) {
    disturbed_since_.reset();
    background.adapt(strip, is_finger);
    return;
  }
  if (!disturbed_since_) disturbed_since_ = quiet_since_ = now;
  if (std::ranges::find(is_finger, true) != is_finger.end()) quiet_since_ = now;
  if (now - quiet_since_ >= relearn_after_quiet || now - *disturbed_since_ >= relearn_at_last) {
    known_ = false;
    begin_to_learn(strip, now);
  }
}

void BackgroundLearner::learn(BackgroundStrip& background, const BorderStrip& strip, Timestamp now) {
  if (still_frames_ > 0) candidate_.distance(strip);
  if (still_frames_ == 0 || candidate_.unchanged_share() < still_above) return begin_to_learn(strip, now);
  candidate_.adapt(strip, no_finger_);
  ++still_frames_;
  if (still_frames_ < least_frames || now - still_since_ < still_for) return;
  background = candidate_;
  relearned_ += had_background_ ? 1 : 0;
  known_ = had_background_ = true;
  disturbed_since_.reset();
}

void BackgroundLearner::begin_to_learn(const BorderStrip& strip, Timestamp now) {
  candidate_.set(strip);
  still_since_ = now;
  still_frames_ = 1;
}

}  // namespace telehug
