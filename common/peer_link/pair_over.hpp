// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace telehug {

// The last word of a side whose pair is over, as the reason in its status: what the other side then tells its user, who
// would else see a peer that is just gone.
inline constexpr const char* pair_over_reason = "the pair was revoked on the other PC, or has expired there";

}  // namespace telehug
