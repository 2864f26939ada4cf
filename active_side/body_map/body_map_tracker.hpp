// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "body_map/body_map.hpp"

namespace telehug {

// Lengths in heights of the followed face.
struct BodyMapTrackerConfig {
  double dead_band_fh = 0.10;  // the grid stands until the face's middle, chin or height is off by more (1/5 of a box)
  Duration hold = 1500ms;      // a turned head or a hand in front of the face is over after that
  double jump_fh = 1.0;        // a face that is off by more ...
  double jump_height = 0.30;   // ... or differs in height by more than this share is another face, not a motion
};

// From finds of the remote face over time to a map that stands still. Every change of the grid gets a new version; a
// version is never used twice. A missed face is held where it was; another face is taken only when the followed one has
// been missing for the hold time, so that one false find doesn't carry the grid away.
class BodyMapTracker {
 public:
  explicit BodyMapTracker(const BodyMapTrackerConfig& config = {}) : config_(config) {}

  // A picture was searched: `face` is the remote face or none, `view` the searched part of the screen, whose bottom
  // ends the grid. When the view has changed nothing is held over from before.
  const BodyMap& searched(Timestamp time, const std::optional<ScreenRect>& face, const ScreenRect& view);

  // The screen shows the same as at the last call.
  const BodyMap& unchanged(Timestamp time);

  // There is no picture of the screen.
  const BodyMap& lost(Timestamp time);

  // Version 0 if there is no map. `seen` is the last time at which the face was there: older than the last call while
  // the map is held.
  [[nodiscard]] const BodyMap& map() const { return map_; }

 private:
  const BodyMap& follow(Timestamp time);
  void replace_map(const BodyMap& fresh);
  [[nodiscard]] bool is_another_face(const ScreenRect& face) const;
  [[nodiscard]] bool left_dead_band(const ScreenRect& face) const;

  BodyMapTrackerConfig config_;
  BodyMap map_;
  ScreenRect view_;
  std::optional<ScreenRect> face_;  // the newest find, in view_
  std::uint32_t last_version_ = 0;
};

}  // namespace telehug
