// SPDX-License-Identifier: Apache-2.0
//
// Keeps the background strip true for as long as the program runs: follows slow changes, notices when the light was
// switched, and learns the background anew then, or at the start if nobody has kept it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/clock.hpp"
#include "finger/background_strip.hpp"

namespace telehug {

class BackgroundLearner {
 public:
  // `known`: what the background strip holds is how the rig looks with nobody there.
  BackgroundLearner(const BorderStrip::Layout& layout, bool known);

  // For every frame that can be believed, after background.distance(strip). `is_finger` has one flag a column. `now`
  // never decreases. Allocates nothing.
  void update(BackgroundStrip& background, const BorderStrip& strip, const std::vector<bool>& is_finger, Timestamp now);

  // There is a background to learn from or to compare with.
  [[nodiscard]] bool knows() const noexcept { return known_; }
  // The strip can be compared with the background: neither unknown nor all different from it.
  [[nodiscard]] bool trusts() const noexcept { return known_ && !disturbed_since_; }
  // How often the background was learnt anew after a disturbance.
  [[nodiscard]] std::uint64_t relearned() const noexcept { return relearned_; }

 private:
  void watch(BackgroundStrip& background, const BorderStrip& strip, const std::vector<bool>& is_finger, Timestamp now);
  void learn(BackgroundStrip& background, const BorderStrip& strip, Timestamp now);
  void begin_to_learn(const BorderStrip& strip, Timestamp now);

  bool known_;
  bool had_background_;
  std::optional<Timestamp> disturbed_since_;
  Timestamp quiet_since_{};  // while it is disturbed: no finger seen
  BackgroundStrip candidate_;
  std::vector<bool> no_finger_;
  Timestamp still_since_{};
  int still_frames_ = 0;  // 0: the candidate is nothing yet
  std::uint64_t relearned_ = 0;
};

}  // namespace telehug
