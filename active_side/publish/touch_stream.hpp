// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "common/clock.hpp"
#include "publish/boxed_contact.hpp"
#include "publish/hug_player.hpp"
#include "publish/touch_event_builder.hpp"

namespace telehug {

// The version that events name while places on the body come from no body map, but from the standard grid itself.
inline constexpr std::uint32_t no_face_version = std::numeric_limits<std::uint32_t>::max();

// All that goes out as touches in one session, from fingers and from hugs, in one sequence of events: it outlives the
// calibrations (each of which has a pipeline of its own) and is there without any. One thread uses it; it allocates
// nothing.
class TouchStream {
 public:
  // session: as made by new_session_id().
  explicit TouchStream(SessionId session) : builder_(std::move(session)) {}

  // Played with each event.
  [[nodiscard]] HugPlayer& hug() noexcept { return hug_; }

  // The event to send now, or null (TouchEventBuilder). `fingers`: all that touch somebody, ids unique;
  // `body_map_version`: of the map that they were read against. While `sending` is false fingers touch nobody, and what
  // they began before is not told again; a hug goes out all the same.
  const TouchEvent* build(const BoxedContacts& fingers, std::uint32_t body_map_version, bool sending,
                          Timestamp frame_time, Timestamp now);

  // Nobody touches the screen, or nobody knows.
  const TouchEvent* build(Timestamp now) { return build({}, 0, false, now, now); }

 private:
  HugPlayer hug_;
  TouchEventBuilder builder_;
  Timestamp newest_{};
};

}  // namespace telehug
