// SPDX-License-Identifier: Apache-2.0
#include "daemon/hug_request.hpp"

#include <fmt/format.h>

namespace telehug {

Result<HugRequest> read_hug_request(const nlohmann::json& request) {
  HugRequest hug;
  if (const auto seconds = request.find("seconds"); seconds != request.end()) {
    const double given = seconds->is_number() ? seconds->get<double>() : 0;
    if (!(given >= HugRequest::shortest_s) || given > HugRequest::longest_s) {
      return Error{fmt::format("\"seconds\" is a number from {} to {}", HugRequest::shortest_s, HugRequest::longest_s)};
    }
    hug.duration = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(given));
  }
  if (const auto strength = request.find("strength"); strength != request.end()) {
    hug.strength = strength->is_number() ? strength->get<double>() : 0;
    if (!(hug.strength > 0) || hug.strength > 1) return Error{"\"strength\" is a number above 0, up to 1"};
  }
  return hug;
}

}  // namespace telehug
