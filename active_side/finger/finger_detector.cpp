// SPDX-License-Identifier: Apache-2.0
#include "finger/finger_detector.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "finger/edge_map.hpp"
#include "finger/finger_axis.hpp"
#include "finger/finger_colours.hpp"
#include "finger/mirror_evidence.hpp"
#include "finger/tip_search.hpp"
#include "finger/tip_shape.hpp"

namespace telehug {
namespace {

constexpr int least_width_px = 320;
constexpr int least_height_px = 180;
constexpr double beside_px = 30;  // columns of the edge map beside the finger

ImageSize checked(ImageSize image) {
  if (image.width_px < least_width_px || image.height_px < least_height_px) {
    throw std::invalid_argument("pictures of this size are too small to look for fingers");
  }
  return image;
}

ImageSize size_of(const cv::Mat& empty) {
  if (empty.type() != CV_8UC3) throw std::invalid_argument("the picture of the empty rig is not in colour");
  return checked({empty.cols, empty.rows});
}

// How the picture shows the screen's normal at a fingertip.
std::optional<ScreenNormal> screen_normal(const RigCamera& camera, const ImagePoint& tip) {
  constexpr double height_mm = 5;
  const auto foot = camera.screen_point(tip);
  if (!foot) return std::nullopt;
  const auto above = camera.project(RigVector{foot->x_mm, foot->y_mm, height_mm});
  if (!above) return std::nullopt;
  const double du = above->u_px - tip.u_px;
  const double dv = above->v_px - tip.v_px;
  if (dv > -1) return std::nullopt;  // seen from straight in front: there is no mirror image beside the finger
  return ScreenNormal{du / dv, std::hypot(du, dv) / height_mm};
}

FingerOutline outline(const FingerAxis& axis, const TipContour& contour, const ImagePoint& tip) {
  FingerOutline finger;
  const double v = axis.border_v_px();
  finger.tip = tip;
  finger.reference_v_px = v;
  finger.centre_u_px = axis.centre_u(v);
  finger.centre_slope = axis.slope();
  finger.half_width_px = axis.half_width(v);
  finger.half_width_slope = (axis.half_width(tip.v_px) - axis.half_width(v)) / std::max(tip.v_px - v, 1.0);
  finger.contour.assign(contour.points.begin(), contour.points.end());
  return finger;
}

BorderStrip sampled(const cv::Mat& bgr, const BorderStrip::Layout& layout) {
  BorderStrip strip(layout);
  strip.sample(bgr, layout);
  return strip;
}

}  // namespace

FingerDetector::FingerDetector(const BorderCurve& border, const cv::Mat& empty)
    : FingerDetector(border, size_of(empty), sampled(empty, BorderStrip::Layout(border, size_of(empty)))) {}

FingerDetector::FingerDetector(const BorderCurve& border, ImageSize image, const std::optional<BorderStrip>& background)
    : border_(border),
      image_(checked(image)),
      layout_(border, image_),
      strip_(layout_),
      background_(layout_, background.value_or(BorderStrip(layout_))),
      learner_(layout_, background.has_value()),
      crossing_finder_(layout_),
      edges_(image_),
      colours_(image_),
      tip_search_(image_),
      is_finger_(static_cast<std::size_t>(layout_.columns), false) {
  axes_.reserve(max_contacts);
  others_.reserve(max_contacts);
}

const Fingers& FingerDetector::detect(const cv::Mat& bgr) {
  fingers_.clear();
  contours_.clear();
  axes_.clear();
  std::fill(is_finger_.begin(), is_finger_.end(), false);
  if (bgr.type() != CV_8UC3 || bgr.cols != image_.width_px || bgr.rows != image_.height_px) {
    ++unfit_pictures_;
    return fingers_;
  }
  strip_.sample(bgr, layout_);
  if (!learner_.knows()) return fingers_;
  const std::vector<float>& foreground = background_.distance(strip_);
  const Crossings& crossings = crossing_finder_.find(foreground, background_.new_edges(), bgr, border_);
  for (const Crossing& crossing : crossings)
    axes_.emplace_back(crossing, border_);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const std::size_t fingers_before = fingers_.size();
    add_finger(bgr, i);
    if (fingers_.size() == fingers_before) continue;
    const Crossing& crossing = crossings[i];
    std::fill(is_finger_.begin() + crossing.first_column, is_finger_.begin() + crossing.last_column + 1, true);
  }
  return fingers_;
}

void FingerDetector::add_finger(const cv::Mat& bgr, std::size_t which) {
  const FingerAxis& axis = axes_[which];
  const double scale = image_.height_px / 720.0;
  const double border_v = axis.border_v_px();
  const int last_v = image_.height_px - 4;

  // Straight fingers would reach the picture's bottom, leaning ones leave its side: their tips are not seen there.
  const double a = axis.half_width(border_v);
  const double first_v = std::max(0.0, border_v - 24 * scale - 4.5 * a);
  const double behind_u = axis.centre_u(first_v);
  const double bottom_u = axis.centre_u(last_v);
  const int left = static_cast<int>(std::min(behind_u, bottom_u) - 1.25 * a - beside_px * scale);
  const int right = static_cast<int>(std::max(behind_u, bottom_u) + 1.25 * a + beside_px * scale);
  edges_.compute(bgr, {left, static_cast<int>(first_v), right - left, image_.height_px - static_cast<int>(first_v)});

  others_.clear();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (i != which) others_.push_back(axes_[i]);
  }
  colours_.learn(bgr, axis, last_v, others_);
  const auto guesses = tip_search_.find(edges_, axis, last_v, scale);
  if (guesses.empty()) return;
  const TipContour contour = contour_finder_.find(bgr, guesses, colours_);
  const double slope = border_.slope_at(axis.centre_u(border_v));
  const TipShape shape = fit_tip_shape(contour, guesses.front().finger_half_width_px, slope);
  const double length_px = shape.tip.v_px - border_.v_at(shape.tip.u_px);
  if (length_px <= 0 || shape.tip.v_px >= last_v || shape.tip.u_px < 0 || shape.tip.u_px > image_.width_px - 1) return;
  Finger finger{shape.tip, length_px, axis.centre_u(border_v) - a, axis.centre_u(border_v) + a};
  finger.width_px = 2 * shape.half_width_px;
  finger.tip_radius_px = shape.half_width_px * shape.half_width_px / shape.half_length_px;
  if (const auto normal = camera_ ? screen_normal(*camera_, shape.tip) : std::nullopt) {
    finger.px_per_mm = normal->px_per_mm;
    finger.mirror = mirror_evidence(bgr, outline(axis, contour, shape.tip), *normal);
  }
  fingers_.push_back(finger);
  contours_.push_back(contour);
}

void FingerDetector::adapt(Timestamp now) {
  learner_.update(background_, strip_, is_finger_, now);
}

}  // namespace telehug
