// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/rig_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace telehug {
namespace {

// Blue, green, red of the skin in full light, Fitzpatrick I to VI.
const std::array<cv::Vec3d, 6> skin_colours{cv::Vec3d{184, 204, 238}, cv::Vec3d{142, 174, 224},
                                            cv::Vec3d{116, 152, 206}, cv::Vec3d{84, 118, 172},
                                            cv::Vec3d{58, 84, 128},   cv::Vec3d{44, 58, 88}};

// Skin is lit from all sides and a little more from above and in front.
const cv::Vec3d towards_light{0.15, -0.83, 0.53};
constexpr double ambient = 0.78;
constexpr double directed = 0.22;

// A coat scatters: the mirror image of what is further away is fainter.
constexpr double mirror_range_mm = 60;

constexpr int noise_shift_px = 64;
const cv::Size blur_size{3, 3};

cv::Mat dark_gradient() {
  cv::Mat picture(16, 1, CV_8UC3);
  for (int row = 0; row < picture.rows; ++row) {
    const int level = 16 + 2 * row;
    picture.at<cv::Vec3b>(row, 0) = {cv::saturate_cast<uchar>(level + 14), cv::saturate_cast<uchar>(level + 4),
                                     cv::saturate_cast<uchar>(level)};
  }
  return picture;
}

RoundCone mirrored_in_screen(RoundCone cone) {
  cone.a[2] = -cone.a[2];
  cone.b[2] = -cone.b[2];
  return cone;
}

cv::Mat half_noise(cv::RNG& generator, cv::Size size, double sd) {
  cv::Mat noise(size, CV_8UC3);
  generator.fill(noise, cv::RNG::NORMAL, 0, sd);  // what is below 0 becomes 0
  return noise;
}

}  // namespace

RigRenderer::RigRenderer(const VirtualRigSettings& settings)
    : settings_(settings), camera_(settings.camera, settings.focal_px, settings.image) {
  const cv::Size size(settings.image.width_px, settings.image.height_px);
  sharp_.create(size, CV_8UC3);
  nearest_t_.create(size, CV_32FC1);
  show(settings.screen_picture.empty() ? dark_gradient() : settings.screen_picture);
  // Each of the two is half of a normal distribution; their difference has mean 0 and about this deviation.
  cv::RNG generator(settings.seed + 0x9E3779B97F4A7C15ULL);
  const cv::Size larger = size + cv::Size(noise_shift_px, noise_shift_px);
  brighter_ = half_noise(generator, larger, settings.noise_sd * 1.2);
  darker_ = half_noise(generator, larger, settings.noise_sd * 1.2);
}

void RigRenderer::show(const cv::Mat& picture) {
  scene_ = render_scene(settings_, camera_, picture);
  cv::Mat blurred;  // a new one: a copy of this renderer may still draw with the old one
  cv::GaussianBlur(scene_.picture, blurred, blur_size, 0);
  blurred_scene_ = blurred;
}

void RigRenderer::draw(const std::optional<FingerPlace>& finger, std::uint64_t noise_index, cv::Mat& bgr) {
  draw_without_noise(finger, bgr);
  if (settings_.noise_sd > 0) add_noise(noise_index, bgr);
}

void RigRenderer::draw_without_noise(const std::optional<FingerPlace>& finger, cv::Mat& bgr) {
  blurred_scene_.copyTo(bgr);
  if (!finger) return;
  const Hand hand = hand_at(*finger);
  const cv::Rect picture({0, 0}, bgr.size());
  drawn_ = {};
  for (const RoundCone& cone : hand) {
    drawn_ |= box_of(cone);
    if (settings_.mirror > 0) drawn_ |= box_of(mirrored_in_screen(cone));
  }
  if (drawn_.empty()) return;
  scene_.picture(drawn_).copyTo(sharp_(drawn_));
  nearest_t_(drawn_) = std::numeric_limits<float>::max();
  if (settings_.mirror > 0) {
    draw_hand(hand, true);
    nearest_t_(drawn_) = std::numeric_limits<float>::max();
  }
  draw_hand(hand, false);
  // The blur looks one pixel beyond what it writes, and the hand stays one pixel inside the box.
  cv::Mat target = bgr(drawn_);
  cv::GaussianBlur(sharp_(drawn_), target, blur_size, 0, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
}

void RigRenderer::draw_hand(const Hand& hand, bool mirrored) {
  for (const RoundCone& cone : hand)
    draw_cone(mirrored ? mirrored_in_screen(cone) : cone, mirrored);
}

void RigRenderer::draw_cone(const RoundCone& cone, bool mirrored) {
  const cv::Rect box = box_of(cone);
  const RoundConeCaster caster(cone, camera_.position_mm());
  const cv::Vec3d& skin = skin_colours[static_cast<std::size_t>(settings_.skin_tone - 1)];
  const RigPoint one_right = camera_.ray(1, 0) - camera_.ray(0, 0);
  for (int v = box.y; v < box.y + box.height; ++v) {
    RigPoint ray = camera_.ray(box.x, v);
    for (int u = box.x; u < box.x + box.width; ++u, ray += one_right) {
      if (mirrored && scene_.is_screen.at<uchar>(v, u) == 0) continue;
      const auto hit = caster.cast(ray);
      auto& nearest_t = nearest_t_.at<float>(v, u);
      if (!hit || hit->t >= static_cast<double>(nearest_t)) continue;
      nearest_t = static_cast<float>(hit->t);
      RigPoint normal = hit->normal;
      if (mirrored) normal[2] = -normal[2];
      cv::Vec3d colour = skin * (ambient + directed * normal.dot(towards_light));
      if (mirrored) {
        const double behind_screen_mm = -(camera_.position_mm()[2] + hit->t * ray[2]);
        colour = colour * (settings_.mirror * std::exp(-behind_screen_mm / mirror_range_mm)) +
                 cv::Vec3d(scene_.unmirrored.at<cv::Vec3b>(v, u));
      }
      sharp_.at<cv::Vec3b>(v, u) = {cv::saturate_cast<uchar>(colour[0]), cv::saturate_cast<uchar>(colour[1]),
                                    cv::saturate_cast<uchar>(colour[2])};
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

void RigRenderer::add_noise(std::uint64_t noise_index, cv::Mat& bgr) const {
  cv::RNG place(noise_index * 0x9E3779B97F4A7C15ULL + settings_.seed + 1);
  const auto shifted = [&](const cv::Mat& noise) {
    const cv::Point corner(place.uniform(0, noise_shift_px), place.uniform(0, noise_shift_px));
    return noise(cv::Rect(corner, bgr.size()));
  };
  cv::add(bgr, shifted(brighter_), bgr);
  cv::subtract(bgr, shifted(darker_), bgr);
}

}  // namespace telehug
