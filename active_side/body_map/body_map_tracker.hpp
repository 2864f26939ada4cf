// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "body_map/body_map.hpp"
#include "body_map/one_euro_filter.hpp"

namespace telehug {

// Lengths in heights of the face (fh).
struct BodyMapTrackerConfig {
  OneEuroOptions filter;             // of the middle, the chin and the logarithm of the height, all three in fh
  double dead_band_fh = 0.10;        // the grid stands until the filtered face is off by more: a fifth of a box ...
  double arrived_fh = 0.025;         // ... and then glides there until it is off by less
  Duration glide = 200ms;            // time constant
  Duration settle = 1s;              // so long after a leap there is no dead band: the first find is only one find
  std::uint32_t versions_after = 0;  // the first version is the next one: no other tracker's of the session
  double leap_fh = 0.5;  // who is off by more has not moved like this: the picture has; the grid leaps after it
};

// The face that the map belongs to.
struct MappedFace {
  std::uint32_t person = 0;  // another number: another face, or the same one elsewhere; the grid leaps there
  ScreenRect face;           // hairline to chin
  Timestamp seen;            // before the time of the update: not seen now, `face` is where it was last
};

// From where the remote face is over time to a map that stands still while somebody sits still, and follows when they
// move. Every change of the grid gets a new version; a version is never used twice.
class BodyMapTracker {
 public:
  explicit BodyMapTracker(const BodyMapTrackerConfig& config = {}, bool mirrored = false);

  // `view`: the part of the screen that shows the person, whose bottom ends the grid. Version 0 if there is no face, or
  // no body below it. Times must rise.
  const BodyMap& update(Timestamp time, const std::optional<MappedFace>& face, const ScreenRect& view);

  // The picture has moved on the screen: the next update leaps.
  void leap_next() { person_ = 0; }

  [[nodiscard]] const BodyMap& map() const { return map_; }

 private:
  void leap(Timestamp time, const MappedFace& face);
  void filter(const MappedFace& face, double seconds);
  void glide(Timestamp time, double seconds);
  void lay(const ScreenRect& view, Timestamp seen);

  BodyMapTrackerConfig config_;
  bool mirrored_;
  BodyMap map_;
  std::uint32_t person_ = 0;  // 0: nobody
  OneEuroFilter middle_mm_, chin_mm_, log_height_;
  double width_per_height_ = 1;
  ScreenRect shown_;  // the face that the grid hangs from
  bool gliding_ = false;
  Timestamp leapt_, updated_, filtered_;
  std::uint32_t last_version_ = 0;
};

}  // namespace telehug
