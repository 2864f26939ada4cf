// SPDX-License-Identifier: Apache-2.0
#include "daemon/peer_absence.hpp"

#include <fmt/format.h>

#include "peer_link/pair_over.hpp"

namespace telehug {

PeerAbsence peer_absence(Side own, bool paired, const std::optional<SideStatus>& told,
                         const std::optional<Stranger>& stranger) {
  const char* program = own == Side::active ? "telehug-passive" : "telehug-active";
  if (!paired) {
    return {"no peer is connected; this PC has no pair, so one on another PC is not heard",
            fmt::format("pair it with the other PC (`telehug pair --help`), or start {} here", program)};
  }
  if (told && told->reason == pair_over_reason) {
    return {fmt::format("no peer is connected: {}", pair_over_reason),
            "pair the two PCs again (`telehug pair --help`)"};
  }
  if (stranger && stranger->refused) {
    return {
        fmt::format("no peer is connected; somebody at {} tried to connect without belonging to this pair",
                    stranger->address),
        "if that is the other PC, compare `telehug pair list` on both, and pair them again unless it shows the same"};
  }
  if (stranger) {
    return {fmt::format("no peer is connected; the handshake with {} comes to no end: one of the two sides does not "
                        "accept the other's pair",
                        stranger->address),
            "if that is the other PC, compare `telehug pair list`, `telehug status` and `date` on both"};
  }
  return {"no peer is connected",
          fmt::format("start {} on the other PC; `telehug pair list` must show this pair there, too, and peer.domain "
                      "must agree",
                      program)};
}

}  // namespace telehug
