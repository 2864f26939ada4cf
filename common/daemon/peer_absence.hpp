// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "common/messages.hpp"
#include "dds/strangers.hpp"

namespace telehug {

struct PeerAbsence {
  std::string what;   // one sentence
  std::string to_do;  // likewise
};

// That no peer is connected, and why, as far as this side can know. `told`: what the peer last told of itself.
[[nodiscard]] PeerAbsence peer_absence(Side own, bool paired, const std::optional<SideStatus>& told,
                                       const std::optional<Stranger>& stranger);

}  // namespace telehug
