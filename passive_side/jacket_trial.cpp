// SPDX-License-Identifier: Apache-2.0
#include "jacket_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

// Of a number under `key`; empty if there is none or it is not within (0, most].
std::optional<double> number_up_to(double most, const nlohmann::json& request, const char* key) {
  if (!request.at(key).is_number()) return std::nullopt;
  const double value = request.at(key).get<double>();
  return std::isfinite(value) && value > 0 && value <= most ? std::optional(value) : std::nullopt;
}

}  // namespace

Result<TrialRequest> read_trial_request(const nlohmann::json& request, const JacketProfile& profile) {
  const auto id = request.find("id");
  if (id == request.end() || !id->is_number_unsigned() || id->get<std::uint64_t>() > 255)
    return Error{"which actuator? give its id, 1 to 255; `telehug jacket list` tells them"};
  TrialRequest trial;
  trial.actuator = static_cast<std::uint8_t>(id->get<std::uint64_t>());
  const auto index = profile.index_of(trial.actuator);
  if (!index) return Error{fmt::format("\"{}\" has no actuator {}", profile.name, trial.actuator)};
  if (!profile.actuators[*index].enabled)
    return Error{fmt::format("actuator {} is switched off by the wearer's own limits", trial.actuator)};
  if (request.contains("strength")) {
    const auto strength = number_up_to(1, request, "strength");
    if (!strength) return Error{"the strength must be a number above 0, at most 1"};
    trial.strength = *strength;
  }
  if (request.contains("seconds")) {
    const auto seconds = number_up_to(std::chrono::duration<double>(longest_trial).count(), request, "seconds");
    if (!seconds) return Error{"the seconds must be a number above 0, at most 5"};
    trial.duration = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*seconds));
  }
  return trial;
}

void JacketTrial::begin(const TrialRequest& request, Timestamp now) noexcept {
  running_ = Running{request, now + request.duration};
}

std::optional<Drive> JacketTrial::drive(Timestamp now, Duration drive_time) noexcept {
  if (!running_) return std::nullopt;
  const auto [request, end] = *running_;
  // An end beyond the request's duration was made by a clock that has jumped back since.
  if (now >= end || end - now > request.duration) {
    running_.reset();
    return Drive{request.actuator, 0, now};
  }
  return Drive{request.actuator, request.strength, std::min(end, now + drive_time)};
}

}  // namespace telehug
