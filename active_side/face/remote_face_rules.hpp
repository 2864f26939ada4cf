// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/clock.hpp"

namespace telehug {

// Who counts as the remote person. Scores are those of the face finder, lengths in heights of the face (fh).
struct RemoteFaceRules {
  // Nobody to touch: a face lower than this share of the picture, and one whose middle is this near to a corner on both
  // axes, where video chats put the user's own picture (thesis).
  double min_height_share = 0.07;
  double corner_share = 0.20;

  // A face is taken when it was found this surely in two of three looks, or at all for a while.
  double sure_score = 0.75;
  double least_score = 0.50;
  Duration unsure_for = 1s;
  // Avatars, posters and animals score up to 0.69 and never move: on a live screen the picture inside a face must have
  // changed twice within this time before it is taken. A held one may sit still. From files a still picture counts.
  Duration changes_within = 2s;
  double still_score = 0.70;

  // The same face in the next look: how far it may have gone, and how much its height may differ.
  double same_place_fh = 0.5;
  double same_height = 0.30;

  // A face that isn't seen is waited for: a turned head, a hand in front of it.
  Duration hold = 1500ms;
  // Another one takes over when it has been so much larger for so long.
  double takeover_ratio = 1.25;
  Duration takeover_after = 1500ms;
};

}  // namespace telehug
