// SPDX-License-Identifier: Apache-2.0
//
// From touches to what the jacket shall do: which actuators, how strong, until when. How strong that may get and
// whether anything happens at all is the safety stage's business.
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <span>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "jacket/jacket_profile.hpp"
#include "rendering/drive_shaper.hpp"
#include "rendering/felt_touch.hpp"
#include "rendering/jacket_plan.hpp"
#include "rendering/motor_mesh.hpp"
#include "rendering/spot.hpp"

namespace telehug {

// A tap that is delivered later than this after it happened is not felt any more: after about 300 ms the wearer no
// longer takes seen and felt touch for one (Shimada 2009).
inline constexpr Duration oldest_tap = 500ms;

// The touches of one sender as they are felt. Where a touch is felt: MotorMesh, and the back only in a hug; or the
// motors of its box. How it goes on with time: FeltTouch. What motors make of it: DriveShaper. Several touches on one
// actuator give the strongest, not the sum.
//
// Whatever is felt ends `drive_duration` after the last event, which tells of all contacts: one that it does not tell
// of is over. What it tells as well is when contacts that were lost began and ended: so a tap or a stroke of which only
// that arrives is felt late.
//
// Nothing allocates but the constructor. One thread uses it; where times go back it begins anew.
class JacketRenderer {
 public:
  // `profile` outlives it.
  JacketRenderer(const JacketProfile& profile, Duration drive_duration);

  // `fresh`: those of the event's transitions that no event before has delivered. The drives tell the whole state and
  // what has just ended. Valid until the next call.
  const JacketPlan& plan(const TouchEvent& event, std::span<const Transition> fresh, Timestamp now);

  // Goes on with what the last event told: call it every 10 ms. What is new since, and no more often than the wire and
  // the microcontroller can follow. Valid until the next call.
  const Drives& tick(Timestamp now);

  // Nothing touches, and nothing that was told is so any more.
  void reset() noexcept;

 private:
  struct Wish {
    double strength = 0;
    Timestamp end;
    void add(double more, Timestamp until) noexcept;
  };
  using Wishes = std::array<Wish, max_actuators>;

  void answer(const TouchEvent& event, std::span<const Transition> fresh);
  void feel(const TouchEvent& event, std::span<const Transition> fresh, Timestamp now);
  void begin(const Contact& contact, Duration least, Timestamp now);
  [[nodiscard]] FeltTouch* touching(std::uint32_t contact_id);
  [[nodiscard]] Duration least_of(bool late_and_over) const;
  void compose(Timestamp now);
  void compose(FeltTouch& touch, Timestamp now, Wishes& wishes);
  [[nodiscard]] Spot spot_of(const Contact& contact, BodyPoint place) const;
  [[nodiscard]] ActuatorIds motors_at(const Contact& contact) const;
  void follow_clock(Timestamp now);

  const JacketProfile& profile_;
  const Duration drive_duration_;
  const BodySide seen_side_;
  const MotorMesh seen_;
  const MotorMesh back_;
  const Pace pace_;
  boost::container::static_vector<FeltTouch, max_contacts + max_transitions> touches_;
  Wishes bursts_;  // of motors that fast strokes have passed
  boost::container::static_vector<DriveShaper, max_actuators> shapers_;
  Timestamp now_;
  Timestamp vouched_until_;
  Timestamp told_;
  JacketPlan plan_;
};

}  // namespace telehug
