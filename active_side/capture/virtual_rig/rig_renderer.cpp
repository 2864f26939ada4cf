// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/rig_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace telehug {
namespace {

constexpr std::size_t shapes_kept = 4;
constexpr int rough_px = 30;  // mirror images blurred by more have no outlines that could be seen

// Whether two poses differ in their place only.
bool same_shape(const HandPose& a, const HandPose& b) {
  if (a.second.has_value() != b.second.has_value()) return false;
  if (a.second) {
    const auto apart = [](const HandPose& pose) {
      return cv::Vec3d(pose.second->foot.x_mm - pose.finger.foot.x_mm, pose.second->foot.y_mm - pose.finger.foot.y_mm,
                       pose.second->hover_mm - pose.finger.hover_mm);
    };
    const bool same_contacts =
        (a.second->hover_mm > 0) == (b.second->hover_mm > 0) && (a.finger.hover_mm > 0) == (b.finger.hover_mm > 0);
    if (!same_contacts || cv::norm(apart(a) - apart(b)) > 0.01) return false;
  }
  return a.posture == b.posture && a.approach_deg == b.approach_deg && a.lean_deg == b.lean_deg &&
         a.turn_deg == b.turn_deg && a.bend_deg == b.bend_deg && a.press_mm == b.press_mm && a.looks == b.looks;
}

// The pixels of all triangles, and some for the outlines' blur.
cv::Rect box_of(const std::vector<SeenHand>& hands, std::vector<RasterVertex> SeenHand::*vertices,
                const cv::Rect& within) {
  static constexpr float far = 1e5F;
  float left = far;
  float top = far;
  float right = -far;
  float bottom = -far;
  for (const SeenHand& hand : hands) {
    for (const RasterVertex& vertex : hand.*vertices) {
      if (vertex.depth_mm <= 1) continue;
      left = std::min(left, vertex.u_px);
      right = std::max(right, vertex.u_px);
      top = std::min(top, vertex.v_px);
      bottom = std::max(bottom, vertex.v_px);
    }
  }
  if (left > right) return {};
  const auto low = [](float x) { return static_cast<int>(std::max(x, -far)) - 2; };
  const auto high = [](float x) { return static_cast<int>(std::min(x, far)) + 3; };
  return cv::Rect(cv::Point(low(left), low(top)), cv::Point(high(right), high(bottom))) & within;
}

cv::Rect grown(const cv::Rect& box, int by, const cv::Rect& within) {
  return cv::Rect(box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by) & within;
}

}  // namespace

RigRenderer::RigRenderer(const VirtualRigSettings& settings)
    : settings_(settings),
      development_(settings),
      mirror_blur_(settings.coat.roughness_deg, settings.focal_px, settings.camera.position_mm[2]),
      raster_({settings.image.width_px, settings.image.height_px}),
      view_(make_view(settings, development_)) {}

void RigRenderer::show(const cv::Mat& picture) {
  view_ = make_view(settings_, picture, development_, view_);
}

std::shared_ptr<RigView> RigRenderer::view(const VirtualRigSettings& settings) {
  return make_view(settings, development_, view_);
}

void RigRenderer::move_screen(double time_s) {
  if (!view_->shown.move_to(time_s)) return;
  const cv::Rect box = view_->window_box;
  if (box.empty()) return;
  develop(*view_, box, development_);
  if (coded_view_ == view_) changed_.push_back(box);
}

const HandShape& RigRenderer::shape_of(const HandPose& pose) {
  for (const auto& known : shapes_) {
    if (!same_shape(known->pose, pose)) continue;
    drawn_.push_back(known);
    return known->shape;
  }
  if (shapes_.size() >= shapes_kept) shapes_.erase(shapes_.begin());
  shapes_.push_back(std::make_shared<const KnownShape>(KnownShape{pose, hand_shape(pose, *pose.looks)}));
  drawn_.push_back(shapes_.back());
  return shapes_.back()->shape;
}

void RigRenderer::draw(const std::optional<FingerPlace>& finger, std::uint64_t noise_index, cv::Mat& bgr) {
  std::vector<HandPose> hands;
  if (finger) hands.emplace_back().finger = *finger;
  draw(hands, noise_index, bgr);
}

void RigRenderer::draw(const std::vector<HandPose>& hands, std::uint64_t noise_index, cv::Mat& bgr) {
  forget_before();
  drawn_.clear();
  seen_.resize(hands.size());
  view_->shadow.clear();
  for (std::size_t i = 0; i < hands.size(); ++i) {
    HandPose pose = hands[i];
    if (!pose.looks) pose.looks = settings_.hand;
    const HandShape& shape = shape_of(pose);
    light_hand(shape, pose.finger, view_->lighting, view_->shown, view_->camera, seen_[i]);
    view_->shadow.add(shape.limbs, shape.place_for(pose.finger), view_->camera);
  }
  if (!hands.empty()) {
    add_shadows();
    mirror_image_.clear();
    const ImagePoint mirrored_px = motion_px(hands.front(), true);
    if (mirror_images_ && settings_.coat.mirror > 0 && raster(true, mirrored_px)) {
      mirror_image_.take(raster_);
      mirror_blur_.apply(mirror_image_);
      motion_blur_.apply(mirror_image_, static_cast<float>(mirrored_px.u_px), static_cast<float>(mirrored_px.v_px));
    }
    const ImagePoint moved_px = motion_px(hands.front(), false);
    blurred_ = std::hypot(moved_px.u_px, moved_px.v_px) > 0.5;
    if (raster(false, moved_px) && blurred_) {
      hand_.take(raster_);
      motion_blur_.apply(hand_, static_cast<float>(moved_px.u_px), static_cast<float>(moved_px.v_px));
    } else {
      hand_.clear();
    }
    compose();
  }
  development_.expose(coded_, development_.exposure_of(coded_, noise_index), bgr);
  development_.add_noise(noise_index, bgr);
  development_.compress(bgr);
}

// The picture without hands.
void RigRenderer::forget_before() {
  if (coded_view_ == view_) {
    for (const cv::Rect& box : changed_)
      view_->coded(box).copyTo(coded_(box));
  } else {
    view_->coded.copyTo(coded_);
    coded_view_ = view_;
  }
  changed_.clear();
}

// By how much the (first) hand's fingertip moves in the picture while the shutter is open.
ImagePoint RigRenderer::motion_px(const HandPose& hand, bool mirrored) const {
  const cv::Vec3d half_mm = hand.velocity_mm_per_s * (settings_.sensor.shutter_s / 2);
  const auto at = [&](double sign) {
    RigPoint p(hand.finger.foot.x_mm, hand.finger.foot.y_mm, hand.finger.hover_mm);
    p += half_mm * sign;
    if (mirrored) p[2] = -p[2];
    return p;
  };
  if (view_->camera.depth_mm(at(-1)) < 20 || view_->camera.depth_mm(at(1)) < 20) return {0, 0};
  const ImagePoint from = view_->camera.project(at(-1));
  const ImagePoint to = view_->camera.project(at(1));
  return {to.u_px - from.u_px, to.v_px - from.v_px};
}

// False if nothing of it is in the picture.
bool RigRenderer::raster(bool mirrored, const ImagePoint& motion_px) {
  const auto vertices = mirrored ? &SeenHand::mirrored : &SeenHand::direct;
  cv::Rect box = box_of(seen_, vertices, mirrored ? view_->screen_box : cv::Rect({0, 0}, coded_.size()));
  const int moved_px = static_cast<int>(std::max(std::abs(motion_px.u_px), std::abs(motion_px.v_px)) / 2) + 1;
  const cv::Rect within = mirrored ? view_->screen_box : cv::Rect({0, 0}, coded_.size());
  if (!box.empty()) box = grown(box, moved_px + (mirrored ? mirror_blur_.reach_px() : 0), within);
  raster_.begin(box);
  if (box.empty()) return false;
  triangles_.clear();
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const std::vector<RasterVertex>& seen = seen_[i].*vertices;
    for (const MeshTriangle& triangle : drawn_[i]->shape.mesh.triangles) {
      const RasterVertex& a = seen[triangle.corners[0]];
      const RasterVertex& b = seen[triangle.corners[1]];
      const RasterVertex& c = seen[triangle.corners[2]];
      if (!(a.depth_mm > 1 && b.depth_mm > 1 && c.depth_mm > 1)) continue;
      if (!triangle.two_sided) {
        const float area = (b.u_px - a.u_px) * (c.v_px - a.v_px) - (c.u_px - a.u_px) * (b.v_px - a.v_px);
        if (mirrored ? area >= 0 : area <= 0) continue;  // seen from behind
      }
      triangles_.push_back({&a, &b, &c});
      raster_.draw(a, b, c);
    }
  }
  raster_.find_outlines(!mirrored || mirror_blur_.reach_px() < rough_px);
  for (const auto& [a, b, c] : triangles_)
    raster_.cover_outlines(*a, *b, *c);
  return true;
}

void RigRenderer::add_shadows() {
  view_->shadow.finish();
  shadow_factor_.resize(static_cast<std::size_t>(coded_.cols));
  shares_.resize(3 * shadow_factor_.size());
  for (int v = 0; v < coded_.rows; ++v) {
    const cv::Range columns = view_->shadow.columns(v);
    if (columns.empty()) continue;
    changed_.emplace_back(columns.start, v, columns.size(), 1);
    view_->shadow.factors(v, shadow_factor_.data());
    for (int u = 0; u < columns.size(); ++u) {
      const auto share =
          static_cast<std::uint16_t>(static_cast<int>(shadow_factor_[static_cast<std::size_t>(u)] * 65535));
      std::fill_n(&shares_[3 * static_cast<std::size_t>(u)], 3, share);
    }
    auto* row = coded_.ptr<std::uint16_t>(v) + 3 * static_cast<std::ptrdiff_t>(columns.start);
    const std::uint16_t* share = shares_.data();
    for (int i = 0; i < 3 * columns.size(); ++i)
      row[i] = static_cast<std::uint16_t>((std::uint32_t{row[i]} * share[i]) >> 16);
  }
}

// Where hands or their mirror images are seen, in bands, since the box around them is mostly not covered by them.
void RigRenderer::compose() {
  constexpr int band_rows = 64;
  const cv::Rect picture({0, 0}, coded_.size());
  const cv::Rect all = grown(raster_.box() | mirror_image_.box, Lens::margin_px, picture);
  for (int v = all.y; v < all.y + all.height; v += band_rows) {
    const int end = std::min(v + band_rows, all.y + all.height);
    const cv::Range near(v - Lens::margin_px, end + Lens::margin_px);
    const cv::Range columns = joined(blurred_ ? hand_.columns_within(near) : raster_.columns_within(near),
                                     mirror_image_.columns_within(near));
    if (columns.empty()) continue;
    const cv::Rect band(columns.start - Lens::margin_px, v, columns.size() + 2 * Lens::margin_px, end - v);
    compose(band & picture);
  }
}

void RigRenderer::compose(const cv::Rect& box) {
  const cv::Rect around = grown(box, Lens::margin_px, {{0, 0}, coded_.size()});
  development_.lens().code(around, box, coded_, [&](int v, Light* row) {
    compose_row(v, {around.x, around.x + around.width}, row - around.x);
  });
  changed_.push_back(box);
}

// Light from back to front.
void RigRenderer::compose_row(int v, const cv::Range& columns, Light* row) {
  light_of(view_->light.ptr<std::uint16_t>(v) + 3 * static_cast<std::ptrdiff_t>(columns.start), 3 * columns.size(),
           row[columns.start].val);
  const cv::Range may_be_shaded = view_->shadow.columns(v);
  const cv::Range shaded = may_be_shaded & columns;
  if (!shaded.empty()) {
    view_->shadow.factors(v, shadow_factor_.data());
    for (int u = shaded.start; u < shaded.end; ++u) {
      const float factor = shadow_factor_[static_cast<std::size_t>(u - may_be_shaded.start)];
      row[u] *= factor * factor;
    }
  }
  const float* reflectance = view_->scene->reflectance.ptr<float>(v);
  const Light* behind = view_->scene->mirrored.ptr<Light>(v);
  const cv::Range mirrored = mirror_image_.columns_within({v, v + 1}) & columns;
  const auto* image = mirror_image_.image.ptr<cv::Vec4f>(v - mirror_image_.box.y) - mirror_image_.box.x;
  for (int u = mirrored.start; u < mirrored.end; ++u) {
    for (int c = 0; c < 3; ++c)
      row[u][c] += reflectance[u] * (image[u][c] - image[u][3] * behind[u][c]);
  }
  if (blurred_) {
    const cv::Range seen = hand_.columns_within({v, v + 1}) & columns;
    const auto* hand = hand_.image.ptr<cv::Vec4f>(v - hand_.box.y) - hand_.box.x;
    for (int u = seen.start; u < seen.end; ++u) {
      for (int c = 0; c < 3; ++c)
        row[u][c] = row[u][c] * (1 - hand[u][3]) + hand[u][c];
    }
    return;
  }
  raster_.row(v, columns, [&](int u, const Light& light, float coverage, float /*height_mm*/) {
    row[u] = row[u] * (1 - coverage) + light * coverage;
  });
}

}  // namespace telehug
