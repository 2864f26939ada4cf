// SPDX-License-Identifier: Apache-2.0
#include "body_map/body_map_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "body_map/vitruvian_grid.hpp"

namespace telehug {
namespace {

double middle_of(const ScreenRect& face) {
  return face.x_mm + face.width_mm / 2;
}

double chin_of(const ScreenRect& face) {
  return face.y_mm + face.height_mm;
}

ScreenRect face_at(double middle_mm, double chin_mm, double height_mm, double width_per_height) {
  const double width_mm = height_mm * width_per_height;
  return {.x_mm = middle_mm - width_mm / 2, .y_mm = chin_mm - height_mm, .width_mm = width_mm, .height_mm = height_mm};
}

// The largest of the three moves, in heights of `from`.
double offset_fh(const ScreenRect& from, const ScreenRect& to) {
  return std::max({std::abs(middle_of(to) - middle_of(from)) / from.height_mm,
                   std::abs(chin_of(to) - chin_of(from)) / from.height_mm,
                   std::abs(std::log(to.height_mm / from.height_mm))});
}

bool same(const ScreenRect& a, const ScreenRect& b) {
  return a.x_mm == b.x_mm && a.y_mm == b.y_mm && a.width_mm == b.width_mm && a.height_mm == b.height_mm;
}

double seconds_between(Timestamp from, Timestamp to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

BodyMapTracker::BodyMapTracker(const BodyMapTrackerConfig& config, bool mirrored)
    : config_(config),
      mirrored_(mirrored),
      middle_mm_(config.filter),
      chin_mm_(config.filter),
      log_height_(config.filter),
      last_version_(config.versions_after) {}

const BodyMap& BodyMapTracker::update(Timestamp time, const std::optional<MappedFace>& face, const ScreenRect& view) {
  if (!face || !(face->face.height_mm > 0)) {
    person_ = 0;
    map_ = {};
    return map_;
  }
  const bool seen_now = face->seen == time;
  if (face->person != person_ || (seen_now && offset_fh(shown_, face->face) > config_.leap_fh)) {
    leap(time, *face);
  } else {
    if (seen_now) filter(*face, seconds_between(filtered_, time));
    glide(time, seconds_between(updated_, time));
  }
  updated_ = time;
  if (seen_now) filtered_ = time;
  lay(view, face->seen);
  return map_;
}

void BodyMapTracker::leap(Timestamp time, const MappedFace& face) {
  leapt_ = time;
  person_ = face.person;
  middle_mm_.reset(middle_of(face.face));
  chin_mm_.reset(chin_of(face.face));
  log_height_.reset(std::log(face.face.height_mm));
  width_per_height_ = face.face.width_mm / face.face.height_mm;
  shown_ = face.face;
  gliding_ = false;
}

void BodyMapTracker::filter(const MappedFace& face, double seconds) {
  if (!(seconds > 0)) return;
  const double unit_mm = shown_.height_mm;
  middle_mm_.update(middle_of(face.face), seconds, unit_mm);
  chin_mm_.update(chin_of(face.face), seconds, unit_mm);
  log_height_.update(std::log(face.face.height_mm), seconds);
}

void BodyMapTracker::glide(Timestamp time, double seconds) {
  const ScreenRect aim =
      face_at(middle_mm_.value(), chin_mm_.value(), std::exp(log_height_.value()), width_per_height_);
  const double off_fh = offset_fh(shown_, aim);
  const bool settles = time - leapt_ < config_.settle;
  gliding_ = off_fh > (gliding_ || settles ? config_.arrived_fh : config_.dead_band_fh);
  if (!gliding_ || !(seconds > 0)) return;
  const double share = 1 - std::exp(-seconds / std::chrono::duration<double>(config_.glide).count());
  shown_ = face_at(std::lerp(middle_of(shown_), middle_of(aim), share), std::lerp(chin_of(shown_), chin_of(aim), share),
                   std::lerp(shown_.height_mm, aim.height_mm, share), width_per_height_);
}

void BodyMapTracker::lay(const ScreenRect& view, Timestamp seen) {
  auto fresh = make_body_map(shown_, view, mirrored_);
  if (!fresh) {
    map_ = {};
    return;
  }
  const bool moved = map_.version == 0 || !same(fresh->face, map_.face) || !same(fresh->grid, map_.grid) ||
                     !same(fresh->visible, map_.visible);
  fresh->version = moved ? ++last_version_ : map_.version;
  fresh->seen = seen;
  map_ = *fresh;
}

}  // namespace telehug
