// SPDX-License-Identifier: Apache-2.0
//
// What two PCs say to each other once both have proved that they know the code. How a request or a grant is made is not
// known here.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "common/messages.hpp"
#include "common/result.hpp"
#include "pairing_link/tls_channel.hpp"

namespace telehug {

struct Offer {
  Side side = Side::active;
  // Active side: asks, and takes what was granted.
  std::function<Result<std::string>()> make_request;
  std::function<Status(const std::string& grant)> accept;
  // Passive side. If the pairing fails after this, the caller takes back what it granted.
  std::function<Result<std::string>(const std::string& request)> grant_for;
};

// `idle`: the longest silence of the other PC. What fails here is told to the other PC, too; its own words come from
// outside and are to be shown as plain text.
[[nodiscard]] Status talk(TlsChannel& channel, const Offer& offer, std::chrono::milliseconds idle);

}  // namespace telehug
