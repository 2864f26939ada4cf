// SPDX-License-Identifier: Apache-2.0
#include "body_map/body_map_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "body_map/vitruvian_grid.hpp"

namespace telehug {
namespace {

struct Offset {
  double place_fh;  // the larger of the middle's and the chin's move
  double height_fh;
};

Offset offset(const ScreenRect& from, const ScreenRect& to) {
  const double middle_mm = to.x_mm + to.width_mm / 2 - (from.x_mm + from.width_mm / 2);
  const double chin_mm = to.y_mm + to.height_mm - (from.y_mm + from.height_mm);
  return {.place_fh = std::max(std::abs(middle_mm), std::abs(chin_mm)) / from.height_mm,
          .height_fh = std::abs(to.height_mm - from.height_mm) / from.height_mm};
}

bool same(const ScreenRect& a, const ScreenRect& b) {
  return a.x_mm == b.x_mm && a.y_mm == b.y_mm && a.width_mm == b.width_mm && a.height_mm == b.height_mm;
}

}  // namespace

bool BodyMapTracker::is_another_face(const ScreenRect& face) const {
  const Offset off = offset(map_.face, face);
  return off.place_fh > config_.jump_fh || off.height_fh > config_.jump_height;
}

bool BodyMapTracker::left_dead_band(const ScreenRect& face) const {
  const Offset off = offset(map_.face, face);
  return std::max(off.place_fh, off.height_fh) > config_.dead_band_fh;
}

const BodyMap& BodyMapTracker::searched(Timestamp time, const std::optional<ScreenRect>& face, const ScreenRect& view) {
  if (!same(view, view_)) {
    map_ = {};
  }
  view_ = view;
  face_ = face;
  return follow(time);
}

const BodyMap& BodyMapTracker::unchanged(Timestamp time) {
  return follow(time);
}

const BodyMap& BodyMapTracker::lost(Timestamp time) {
  face_.reset();
  return follow(time);
}

const BodyMap& BodyMapTracker::follow(Timestamp time) {
  std::optional<BodyMap> fresh;
  if (face_) {
    fresh = make_body_map(*face_, view_.y_mm + view_.height_mm);
  }
  if (fresh && map_.version != 0 && !is_another_face(*face_)) {
    if (left_dead_band(*face_)) {
      replace_map(*fresh);
    }
    map_.seen = time;
    return map_;
  }
  if (map_.version != 0 && time - map_.seen > config_.hold) {
    map_ = {};
  }
  if (fresh && map_.version == 0) {
    replace_map(*fresh);
    map_.seen = time;
  }
  return map_;
}

void BodyMapTracker::replace_map(const BodyMap& fresh) {
  map_ = fresh;
  map_.version = ++last_version_;
}

}  // namespace telehug
