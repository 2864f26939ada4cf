// SPDX-License-Identifier: Apache-2.0
#include "finger/finger_detector.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "finger/mirror_evidence.hpp"
#include "finger/picture_scale.hpp"
#include "finger/tip_patch.hpp"

namespace telehug {
namespace {

constexpr int least_width_px = 320;
constexpr int least_height_px = 180;
constexpr double least_overview_logit = -1;  // a tip that is looked at more closely
constexpr double least_present_logit = -1;
constexpr double agreeing_patch_columns = 5;  // looks further apart than that are followed by another one

ImageSize checked(ImageSize image) {
  if (image.width_px < least_width_px || image.height_px < least_height_px) {
    throw std::invalid_argument("pictures of this size are too small to look for fingers");
  }
  return image;
}

// Of all that does not depend on where the patches lay.
TipLook mean(const TipLook& a, const TipLook& b) {
  TipLook both = a;
  both.present_logit = (a.present_logit + b.present_logit) / 2;
  both.touches_logit = (a.touches_logit + b.touches_logit) / 2;
  both.hover_mm = (a.hover_mm + b.hover_mm) / 2;
  both.width = (a.width + b.width) / 2;
  return both;
}

}  // namespace

FingerDetector::FingerDetector(const BorderCurve& border, ImageSize image, const std::optional<BorderStrip>& background,
                               const std::optional<RigCamera>& camera)
    : border_(border),
      image_(checked(image)),
      camera_(camera),
      layout_(border, image_),
      strip_(layout_),
      background_(layout_, background.value_or(BorderStrip(layout_))),
      learner_(layout_, background.has_value()),
      overview_(border, layout_, px_per_mm_at_border(camera, border, image)),
      is_finger_(static_cast<std::size_t>(layout_.columns), false) {
  for (const int columns : overview_.tile_columns())
    overview_nets_.emplace_back(overview_.rows(), columns);
}

double FingerDetector::px_per_mm(const ImagePoint& place) const {
  return px_per_mm_at(camera_, image_, place);
}

const Fingers& FingerDetector::detect(const cv::Mat& bgr) {
  fingers_.clear();
  std::fill(is_finger_.begin(), is_finger_.end(), false);
  if (bgr.type() != CV_8UC3 || bgr.cols != image_.width_px || bgr.rows != image_.height_px) {
    ++unfit_pictures_;
    return fingers_;
  }
  strip_.sample(bgr, layout_);
  if (!learner_.knows()) return fingers_;
  for (const Overview::Tile& tile : overview_.tiles(background_.distance(strip_))) {
    OverviewNet& net = overview_nets_[tile.width];
    overview_.sample(bgr, tile.first_column, overview_.tile_columns()[tile.width], net.cells());
    for (const OverviewNet::Tip& tip : net.find(least_overview_logit))
      add_finger(bgr, overview_.picture_point(tile.first_column + tip.column, tip.row));
  }
  return fingers_;
}

void FingerDetector::add_finger(const cv::Mat& bgr, const ImagePoint& near) {
  if (fingers_.size() == fingers_.capacity()) return;
  const auto finger = look_at(bgr, near);
  if (!finger) return;
  const bool known = std::any_of(fingers_.begin(), fingers_.end(), [&](const Finger& other) {
    return std::hypot(other.tip.u_px - finger->tip.u_px, other.tip.v_px - finger->tip.v_px) < other.width_px / 2;
  });
  if (known) return;
  fingers_.push_back(*finger);
  mark_columns(*finger);
}

FingerDetector::Look FingerDetector::look_once(const cv::Mat& bgr, const ImagePoint& near, bool mirrored) {
  PatchPlace place;
  place.columns = TipNet::columns;
  place.rows = TipNet::rows;
  place.step_px = px_per_mm(near) / patch_px_per_mm;
  place.row_step_px = place.step_px / patch_rows_per_column;
  place.mirrored = mirrored;
  place.middle = near;
  const ImagePoint beside = place.picture_point(TipNet::tip_column, TipNet::tip_row);
  place.middle = {2 * near.u_px - beside.u_px, 2 * near.v_px - beside.v_px};
  sample_patch(bgr, place, tip_net_.patch());
  const double half_width_px = image_.width_px / 2.0;
  const double u = (near.u_px - half_width_px) / half_width_px;
  const double v = (near.v_px - image_.height_px / 2.0) / half_width_px;
  const TipLook seen = tip_net_.look(mirrored ? -u : u, v);
  return {place.picture_point(seen.column, seen.row), place.step_px, seen};
}

// A patch is laid where the tip should be, and once more about what was found, mirrored: what the net mistakes in a
// hand it seldom mistakes in the other one. What both looks say is averaged, if need be those of the second and a third
// one.
std::optional<Finger> FingerDetector::look_at(const cv::Mat& bgr, const ImagePoint& near) {
  Look before = look_once(bgr, near, false);
  Look last = look_once(bgr, before.tip, true);
  const double apart_px = std::hypot(last.tip.u_px - before.tip.u_px, last.tip.v_px - before.tip.v_px);
  if (apart_px > agreeing_patch_columns * last.step_px) {
    before = last;
    last = look_once(bgr, last.tip, false);
  }
  const ImagePoint tip{(before.tip.u_px + last.tip.u_px) / 2, (before.tip.v_px + last.tip.v_px) / 2};
  const TipLook look = mean(before.seen, last.seen);
  const double length_px = tip.v_px - border_.v_at(tip.u_px);
  if (look.present_logit < least_present_logit || length_px <= 0) return std::nullopt;
  if (tip.v_px >= image_.height_px || tip.u_px < 0 || tip.u_px > image_.width_px - 1) return std::nullopt;
  const double width_px = look.width * last.step_px;
  Finger finger{tip, length_px, tip.u_px - width_px / 2, tip.u_px + width_px / 2};
  finger.width_px = width_px;
  finger.contact = tip;
  if (camera_) {
    finger.px_per_mm = px_per_mm(tip);
    finger.mirror = mirror_evidence(look.touches_logit, look.hover_mm);
  }
  return finger;
}

// What differs from the background about a finger is the hand it belongs to.
void FingerDetector::mark_columns(const Finger& finger) {
  const double reach_px = 4 * finger.width_px + finger.length_px;
  const auto column = [&](double u_px) {
    return std::clamp(static_cast<int>(u_px / layout_.column_px), 0, layout_.columns - 1);
  };
  std::fill(is_finger_.begin() + column(finger.tip.u_px - reach_px),
            is_finger_.begin() + column(finger.tip.u_px + reach_px) + 1, true);
}

void FingerDetector::adapt(Timestamp now) {
  learner_.update(background_, strip_, is_finger_, now);
}

}  // namespace telehug
