// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "jacket/jacket_profile.hpp"
#include "safety/safety_stage.hpp"

namespace telehug {

// From an answer of the wearer's side to the bytes for the toucher's own actuators. One thread uses it, with times of
// one clock.
class FeltDrive {
 public:
  // strength: 0..1. Throws std::invalid_argument as SafetyStage does.
  FeltDrive(JacketProfile profile, std::unique_ptr<JacketLink> link, double strength);

  void feel(const Felt& answer, Timestamp now);
  // While stopped nothing is driven.
  void follow_stop(bool stopped, Timestamp now);
  // Serves the link, as SafetyStage's.
  void tick(Timestamp now);

  // What stands between the toucher and feeling something; empty if nothing does.
  [[nodiscard]] std::string problem() const;

 private:
  const JacketProfile profile_;
  const double strength_;
  SafetyStage safety_;
};

}  // namespace telehug
