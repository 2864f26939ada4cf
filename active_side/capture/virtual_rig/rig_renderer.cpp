// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/rig_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace telehug {
namespace {

constexpr std::size_t shapes_kept = 4;

bool same_looks(const HandLooks& a, const HandLooks& b) {
  return a.left == b.left && a.skin_tone == b.skin_tone && a.finger_width_mm == b.finger_width_mm &&
         a.nail_mm == b.nail_mm && a.polish == b.polish && a.ring == b.ring && a.sleeve == b.sleeve &&
         a.sleeve_tint == b.sleeve_tint;
}

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
  return a.approach_deg == b.approach_deg && a.lean_deg == b.lean_deg && a.turn_deg == b.turn_deg &&
         a.bend_deg == b.bend_deg && a.press_mm == b.press_mm && same_looks(*a.looks, *b.looks);
}

// The pixels of all triangles, and some for the outlines' blur.
cv::Rect box_of(const std::vector<SeenHand>& hands, std::vector<RasterVertex> SeenHand::*vertices,
                const cv::Rect& within) {
  constexpr float far = 1e5F;
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
  const auto low = [far](float x) { return static_cast<int>(std::max(x, -far)) - 2; };
  const auto high = [far](float x) { return static_cast<int>(std::min(x, far)) + 3; };
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
  view_ = make_view(settings_, picture, development_);
}

std::shared_ptr<RigView> RigRenderer::view(const VirtualRigSettings& settings) {
  return make_view(settings, development_);
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
  view_->coded.copyTo(coded_);
  drawn_.clear();
  seen_.resize(hands.size());
  view_->shadow.clear();
  for (std::size_t i = 0; i < hands.size(); ++i) {
    HandPose pose = hands[i];
    if (!pose.looks) pose.looks = settings_.hand;
    const HandShape& shape = shape_of(pose);
    light_hand(shape, pose.finger, view_->lighting, view_->scene, view_->camera, seen_[i]);
    view_->shadow.add(shape.limbs, shape.place_for(pose.finger), view_->camera);
  }
  if (!hands.empty()) {
    add_shadows();
    const cv::Rect picture({0, 0}, coded_.size());
    const cv::Rect hand_box = raster(false, hand_image_, heights_);
    const cv::Rect mirror_box = settings_.coat.mirror > 0 ? raster(true, mirror_image_, heights_) : cv::Rect();
    if (!mirror_box.empty()) mirror_blur_.apply(mirror_image_, heights_);
    const cv::Rect changed = hand_box | mirror_box;
    if (!changed.empty()) compose(grown(changed, Development::margin_px, picture), hand_box, mirror_box);
  }
  development_.expose(coded_, development_.exposure_of(coded_, noise_index), bgr);
  development_.add_noise(noise_index, bgr);
  development_.compress(bgr);
}

cv::Rect RigRenderer::raster(bool mirrored, cv::Mat& image, cv::Mat& height_mm) {
  const auto vertices = mirrored ? &SeenHand::mirrored : &SeenHand::direct;
  cv::Rect box = box_of(seen_, vertices, mirrored ? view_->screen_box : cv::Rect({0, 0}, coded_.size()));
  if (box.empty()) return {};
  if (mirrored) box = grown(box, mirror_blur_.reach_px(), view_->screen_box);
  raster_.begin(box);
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
  raster_.find_outlines();
  for (const auto& [a, b, c] : triangles_)
    raster_.cover_outlines(*a, *b, *c);
  raster_.finish(image, height_mm);
  return box;
}

void RigRenderer::add_shadows() {
  shadow_box_ = view_->shadow.finish(shadow_factor_);
  for (int v = 0; v < shadow_box_.height; ++v) {
    const float* factor = shadow_factor_.ptr<float>(v);
    auto* row = coded_.ptr<cv::Vec3w>(v + shadow_box_.y) + shadow_box_.x;
    for (int u = 0; u < shadow_box_.width; ++u) {
      if (factor[u] > 0.999F) continue;
      const int of_65536 = static_cast<int>(factor[u] * 65536);
      for (int c = 0; c < 3; ++c)
        row[u][c] = static_cast<std::uint16_t>((row[u][c] * of_65536) >> 16);
    }
  }
}

// Light of a box, from back to front, with what lies around it for the lens' blur.
void RigRenderer::compose(const cv::Rect& box, const cv::Rect& hand_box, const cv::Rect& mirror_box) {
  const cv::Rect around = grown(box, Development::margin_px, {{0, 0}, coded_.size()});
  view_->light(around).copyTo(composed_);
  const cv::Rect shaded = around & shadow_box_;
  for (int v = shaded.y; v < shaded.y + shaded.height; ++v) {
    const float* factor = shadow_factor_.ptr<float>(v - shadow_box_.y) - shadow_box_.x;
    Light* row = composed_.ptr<Light>(v - around.y) - around.x;
    for (int u = shaded.x; u < shaded.x + shaded.width; ++u)
      row[u] *= factor[u] * factor[u];
  }
  for (int v = mirror_box.y; v < mirror_box.y + mirror_box.height; ++v) {
    const auto* image = mirror_image_.ptr<cv::Vec4f>(v - mirror_box.y) - mirror_box.x;
    const float* reflectance = view_->scene.reflectance.ptr<float>(v);
    const Light* behind = view_->scene.mirrored.ptr<Light>(v);
    Light* row = composed_.ptr<Light>(v - around.y) - around.x;
    for (int u = mirror_box.x; u < mirror_box.x + mirror_box.width; ++u) {
      const cv::Vec4f& seen = image[u];
      if (seen[3] <= 0) continue;
      for (int c = 0; c < 3; ++c)
        row[u][c] += reflectance[u] * (seen[c] - seen[3] * behind[u][c]);
    }
  }
  for (int v = hand_box.y; v < hand_box.y + hand_box.height; ++v) {
    const auto* image = hand_image_.ptr<cv::Vec4f>(v - hand_box.y) - hand_box.x;
    Light* row = composed_.ptr<Light>(v - around.y) - around.x;
    for (int u = hand_box.x; u < hand_box.x + hand_box.width; ++u) {
      const cv::Vec4f& seen = image[u];
      if (seen[3] <= 0) continue;
      for (int c = 0; c < 3; ++c)
        row[u][c] = row[u][c] * (1 - seen[3]) + seen[c];
    }
  }
  development_.code(composed_, coded_part_);
  coded_part_({box.x - around.x, box.y - around.y, box.width, box.height}).copyTo(coded_(box));
}

}  // namespace telehug
