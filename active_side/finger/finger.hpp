// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <optional>

#include "common/messages.hpp"
#include "common/units.hpp"
#include "finger/mirror_state.hpp"

namespace telehug {

// One finger that crosses the bottom border, as a detector sees it.
struct Finger {
  ImagePoint tip;        // foremost point of the finger on the screen's side of the border
  double length_px = 0;  // how far the tip reaches past the image of the screen's bottom edge (thesis: l), > 0
  double left_px = 0;    // columns of the finger's two edges at the border, left_px < right_px
  double right_px = 0;
  double width_px = 0;  // of the finger right behind its tip; 0: not measured
  // Where it touches, if the detector knows more than its foremost point.
  std::optional<ImagePoint> contact = std::nullopt;
  double px_per_mm = 0;  // of the picture at the tip; 0: not known
  MirrorEvidence mirror = {};
};

using Fingers = boost::container::static_vector<Finger, max_contacts>;

}  // namespace telehug
