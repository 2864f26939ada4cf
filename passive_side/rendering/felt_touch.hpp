// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "jacket/jacket_profile.hpp"
#include "rendering/feel.hpp"
#include "rendering/felt_path.hpp"

namespace telehug {

// One contact as it is felt: where, how strong and for how long, from its begin until what is felt of it is over, which
// may be later than the finger is gone. Times do not go back.
class FeltTouch {
 public:
  // Where the rendering is by boxes the contact is felt as the sender gives it: at once, without a way, at its
  // strength, for `least` at least.
  FeltTouch(const Contact& contact, Rendering rendering, Duration least, Timestamp now);

  // The contact's newest state; of one that is down.
  void follow(const Contact& contact, Timestamp now);
  // It has ended, where and as what this says.
  void lift(const Contact& contact, Timestamp now);
  void lift(Timestamp now);

  [[nodiscard]] const Contact& contact() const noexcept { return contact_; }
  [[nodiscard]] bool lifted() const noexcept { return lifted_; }
  // Until when it is felt if nothing more is heard of it: what is lifted ends then, what is down is renewed before.
  [[nodiscard]] Timestamp ends() const noexcept { return ends_; }
  [[nodiscard]] bool over(Timestamp now) const noexcept;

  // 0..1, the newest of its sender.
  [[nodiscard]] double strength() const noexcept;
  // 0..1: how much of that is felt now.
  [[nodiscard]] double level(Timestamp now);
  // 0..1: how much of it is warmth now.
  [[nodiscard]] double warmth(Timestamp now) const;

  [[nodiscard]] FeltPath& path() noexcept { return path_; }
  [[nodiscard]] const FeltPath& path() const noexcept { return path_; }

 private:
  [[nodiscard]] double level_wanted(Timestamp now) const;
  void note_rest(BodyPoint place, Timestamp now);

  Contact contact_;
  Rendering rendering_;
  FeltPath path_;
  Timestamp began_;
  Timestamp pulse_ends_;
  Timestamp ends_ = Timestamp::max();
  bool lifted_ = false;
  BodyPoint rest_;
  Timestamp rests_since_;
  Timestamp hugs_since_;
  SteadyLevel level_;
};

}  // namespace telehug
