// SPDX-License-Identifier: Apache-2.0
//
// {"command":"hug"} on either side's local socket.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "common/clock.hpp"
#include "common/result.hpp"

namespace telehug {

struct HugRequest {
  static constexpr double shortest_s = 0.5;
  static constexpr double longest_s = 10;
  static constexpr double usual_strength = 0.7;

  std::optional<Duration> duration;  // as asked for
  double strength = usual_strength;  // above 0, up to 1
};

[[nodiscard]] Result<HugRequest> read_hug_request(const nlohmann::json& request);

}  // namespace telehug
