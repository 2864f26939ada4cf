// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "body_map/body_map.hpp"
#include "common/clock.hpp"
#include "publish/boxed_contact.hpp"
#include "touch/contact_state.hpp"

namespace telehug {

// Why a contact touches nobody.
struct NobodyTouched {
  std::uint64_t no_face = 0;
  std::uint64_t map_too_old = 0;
  std::uint64_t outside_grid = 0;
};

// The contacts of a frame that lie on the remote person, each with the box and the place on the body it is on; the
// others are counted once, when they begin. A map older than `max_age` at `now` touches nobody.
[[nodiscard]] BoxedContacts boxes_under(const ContactStates& contacts, const BodyMap& map, Duration max_age,
                                        Timestamp now, NobodyTouched& nobody);

}  // namespace telehug
