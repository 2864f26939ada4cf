// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/rig_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "capture/virtual_rig/screen_content.hpp"

namespace telehug {
namespace {

// Blue, green, red of the skin in full light, Fitzpatrick I to VI.
const std::array<Tint, 6> skin_tints{Tint{184, 204, 238}, Tint{142, 174, 224}, Tint{116, 152, 206},
                                     Tint{84, 118, 172},  Tint{58, 84, 128},   Tint{44, 58, 88}};

RoundCone mirrored_in_screen(RoundCone cone) {
  cone.a[2] = -cone.a[2];
  cone.b[2] = -cone.b[2];
  return cone;
}

}  // namespace

RigRenderer::RigRenderer(const VirtualRigSettings& settings)
    : settings_(settings),
      camera_(settings.camera, settings.focal_px, settings.image, settings.distortion_k1),
      lighting_(settings.light),
      development_(settings),
      mirror_blur_(settings.coat.roughness_deg, settings.focal_px, settings.camera.position_mm[2]) {
  const cv::Size size(settings.image.width_px, settings.image.height_px);
  nearest_t_.create(size, CV_32FC1);
  show(settings.screen_picture.empty() ? draw_screen_content(settings.content, settings.screen, settings.seed)
                                       : settings.screen_picture);
}

void RigRenderer::show(const cv::Mat& picture) {
  scene_ = render_scene(settings_, camera_, picture);
  cv::Mat coded;  // a new one: a copy of this renderer may still draw with the old one
  cv::Mat light(scene_.own.size(), CV_32FC3);
  for (int v = 0; v < light.rows; ++v) {
    for (int u = 0; u < light.cols; ++u)
      light.at<Light>(v, u) =
          scene_.own.at<Light>(v, u) + scene_.mirrored.at<Light>(v, u) * scene_.reflectance.at<float>(v, u);
  }
  development_.code(light, coded);
  coded_scene_ = coded;
}

void RigRenderer::draw(const std::optional<FingerPlace>& finger, std::uint64_t noise_index, cv::Mat& bgr) {
  coded_scene_.copyTo(coded_);
  if (finger) {
    const Hand hand = hand_at(*finger);
    const cv::Rect picture({0, 0}, coded_.size());
    cv::Rect box;
    for (const RoundCone& cone : hand)
      box |= box_of(cone) | box_of(mirrored_in_screen(cone));
    if (!box.empty()) {
      const int margin = 2 * Development::margin_px;
      const cv::Rect around =
          cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) & picture;
      cv::Mat layer(coded_.size(), CV_32FC4, cv::Scalar::all(0));
      cv::Mat mirror(coded_.size(), CV_32FC4, cv::Scalar::all(0));
      cv::Mat height(coded_.size(), CV_32FC1, cv::Scalar::all(0));
      draw_hand(hand, true, mirror, height);
      cv::Mat mirror_part = mirror(around);
      mirror_blur_.apply(mirror_part, height(around));
      draw_hand(hand, false, layer, height);
      cv::Mat light(around.size(), CV_32FC3);
      for (int v = 0; v < light.rows; ++v) {
        for (int u = 0; u < light.cols; ++u) {
          const cv::Point at(u + around.x, v + around.y);
          const auto& m = mirror.at<cv::Vec4f>(at);
          const auto& h = layer.at<cv::Vec4f>(at);
          const Light mirrored = scene_.mirrored.at<Light>(at) * (1 - m[3]) + Light{m[0], m[1], m[2]};
          const Light behind = scene_.own.at<Light>(at) + mirrored * scene_.reflectance.at<float>(at);
          light.at<Light>(v, u) = behind * (1 - h[3]) + Light{h[0], h[1], h[2]};
        }
      }
      cv::Mat coded;
      development_.code(light, coded);
      coded.copyTo(coded_(around));
    }
  }
  development_.expose(coded_, development_.exposure_of(noise_index), bgr);
  development_.add_noise(noise_index, bgr);
  development_.compress(bgr);
}

void RigRenderer::draw_hand(const Hand& hand, bool mirrored, cv::Mat& layer, cv::Mat& height_mm) {
  nearest_t_ = std::numeric_limits<float>::max();
  for (const RoundCone& cone : hand)
    draw_cone(mirrored ? mirrored_in_screen(cone) : cone, mirrored, layer, height_mm);
}

void RigRenderer::draw_cone(const RoundCone& cone, bool mirrored, cv::Mat& layer, cv::Mat& height_mm) {
  const cv::Rect box = box_of(cone);
  const RoundConeCaster caster(cone, camera_.position_mm());
  const Light skin = linear(skin_tints[static_cast<std::size_t>(settings_.hand.skin_tone - 1)]);
  for (int v = box.y; v < box.y + box.height; ++v) {
    for (int u = box.x; u < box.x + box.width; ++u) {
      const RigPoint ray = camera_.ray(u, v);
      const auto hit = caster.cast(ray);
      auto& nearest_t = nearest_t_.at<float>(v, u);
      if (!hit || hit->t >= static_cast<double>(nearest_t)) continue;
      nearest_t = static_cast<float>(hit->t);
      cv::Vec3f normal = hit->normal;
      if (mirrored) normal[2] = -normal[2];
      const Light light = product(skin, lighting_.on(normal));
      layer.at<cv::Vec4f>(v, u) = {light[0], light[1], light[2], 1};
      if (mirrored) height_mm.at<float>(v, u) = -static_cast<float>(camera_.position_mm()[2] + hit->t * ray[2]);
    }
  }
}

// The pixels where a cone may be seen, and a margin for the blur; a ball's image is up to 1 / cos of its angle from the
// axis longer than its radius says.
cv::Rect RigRenderer::box_of(const RoundCone& cone) const {
  double left = std::numeric_limits<double>::max();
  double top = left;
  double right = -left;
  double bottom = -left;
  for (const auto& [centre, radius_mm] : {std::pair{cone.a, cone.a_radius_mm}, std::pair{cone.b, cone.b_radius_mm}}) {
    const double depth_mm = camera_.depth_mm(centre);
    if (depth_mm <= radius_mm) return {};  // beside or behind the camera
    const ImagePoint middle = camera_.project(centre);
    const double off_axis = cv::norm(centre - camera_.position_mm()) / depth_mm;
    const double reach_px = camera_.focal_px() * radius_mm / (depth_mm - radius_mm) * off_axis + 3;
    left = std::min(left, middle.u_px - reach_px);
    right = std::max(right, middle.u_px + reach_px);
    top = std::min(top, middle.v_px - reach_px);
    bottom = std::max(bottom, middle.v_px + reach_px);
  }
  const double far = 1e6;  // keeps the box within what an int holds
  const cv::Rect box(
      cv::Point(static_cast<int>(std::max(left, -far)), static_cast<int>(std::max(top, -far))),
      cv::Point(static_cast<int>(std::min(right, far)) + 1, static_cast<int>(std::min(bottom, far)) + 1));
  return box & cv::Rect(0, 0, settings_.image.width_px, settings_.image.height_px);
}

}  // namespace telehug
