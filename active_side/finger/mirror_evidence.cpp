// SPDX-License-Identifier: Apache-2.0
#include "finger/mirror_evidence.hpp"

#include <algorithm>

namespace telehug {
namespace {

// A touch that is not seen is worse than one that motion still tells from hovering.
constexpr double surely_hovering_logit = -1.4;
// Of the fingers that the net learned on, three touch for one that hovers and looks as if it touched.
constexpr double log_odds_learned = 1;
// Of 420 rendered fingers that hover the net is not surer of any that it touches, but of half of those that do.
constexpr double most_log_ratio = 4;

}  // namespace

MirrorEvidence mirror_evidence(double touches_logit, double hover_mm) {
  const double log_ratio = std::clamp(touches_logit - log_odds_learned, -most_log_ratio, most_log_ratio);
  if (touches_logit <= surely_hovering_logit) return {MirrorState::hovering, hover_mm, -log_ratio};
  if (log_ratio > 0) return {MirrorState::touching, 0, log_ratio};
  return {};
}

}  // namespace telehug
