// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "jacket/drive.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

// What the toucher's own actuators do when the wearer's side answers a touch. Empty: nothing, because the touch was not
// felt, or has ended. A touch that begins gives a firm pulse, one that comes to another place a lighter one. `strength`
// 0..1.
[[nodiscard]] std::optional<Drives> felt_pulse(const Felt& felt, const JacketProfile& profile, double strength,
                                               Timestamp now);

}  // namespace telehug
