// SPDX-License-Identifier: Apache-2.0
//
// The wearer tries an actuator, to see that it works and which it is (`telehug jacket test`, `identify`).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "jacket/drive.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

struct TrialRequest {
  std::uint8_t actuator = 0;  // id of the profile
  double strength = 0.7;      // above 0, at most 1
  Duration duration = std::chrono::milliseconds(800);
};

inline constexpr Duration longest_trial = std::chrono::seconds(5);

// {"id": 3, "strength": 0.5, "seconds": 1}; only the id must be there. The error is for whoever asked.
[[nodiscard]] Result<TrialRequest> read_trial_request(const nlohmann::json& request, const JacketProfile& profile);

// Plays one trial at a time: a new one takes the place of what runs. Times of one clock.
class JacketTrial {
 public:
  void begin(const TrialRequest& request, Timestamp now) noexcept;
  void end() noexcept { running_.reset(); }

  // What to ask for now, with an end that is never farther away than drive_time; when the trial is over once more, with
  // strength 0. Empty if there is nothing to ask.
  [[nodiscard]] std::optional<Drive> drive(Timestamp now, Duration drive_time) noexcept;

 private:
  struct Running {
    TrialRequest request;
    Timestamp end;
  };
  std::optional<Running> running_;
};

}  // namespace telehug
