// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "capture/virtual_rig/surroundings.hpp"

namespace telehug {
namespace {

constexpr int reduced = 4;
constexpr float shaded_room = 0.25F;  // share of the room's light that a hand keeps away as well

bool on_desk(Surface surface) {
  return surface == Surface::desk || surface == Surface::foot || surface == Surface::keyboard;
}

bool on_bezel(Surface surface) {
  return surface == Surface::bezel_edge || surface == Surface::bezel_front;
}

cv::Mat share_of(const cv::Mat& surface, const cv::Size& size, bool (*is)(Surface)) {
  cv::Mat mask(surface.size(), CV_32FC1);
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u)
      mask.at<float>(v, u) = is(static_cast<Surface>(surface.at<uchar>(v, u))) ? 1.0F : 0.0F;
  }
  cv::Mat small;
  cv::resize(mask, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

HandShadow::HandShadow(const VirtualRigSettings& settings, const cv::Mat& surface)
    : size_(surface.size()), towards_lamp_(RoomLighting(settings.light).towards()) {
  const cv::Size small((size_.width + reduced - 1) / reduced, (size_.height + reduced - 1) / reduced);
  const auto height_mm = static_cast<float>(settings.screen.height_mm);
  const auto below_mm = static_cast<float>(settings.desk_below_mm);
  const float px = static_cast<float>(size_.width) / 1280 * 30 / reduced;
  planes_[0] = {height_mm + below_mm, share_of(surface, small, on_desk), cv::Mat(small, CV_32FC1), {}, px};
  planes_[1] = {height_mm, share_of(surface, small, on_bezel), cv::Mat(small, CV_32FC1), {}, px / 3};
  const auto directed = static_cast<float>(settings.light.directed);
  const float lamp = directed * 2 * std::max(0.1F, -towards_lamp_[1]);
  strength_ = (lamp + shaded_room * (1 - directed)) / (lamp + 1 - directed);
}

void HandShadow::clear() {
  for (Plane& plane : planes_) {
    plane.density = 0.0F;
    plane.box = {};
  }
}

void HandShadow::add(const std::vector<Limb>& limbs, const cv::Vec3f& origin, const PinholeCamera& camera) {
  cv::Vec3f along = -towards_lamp_;
  along[1] = std::max(along[1], 0.35F);  // a lamp at table height would throw endless shadows
  for (Plane& plane : planes_) {
    for (const Limb& limb : limbs) {
      const auto carried = [&](const cv::Vec3f& place) {
        const cv::Vec3f p = place + origin;
        return RigPoint(p + along * (std::max(0.0F, plane.y_mm - p[1]) / along[1]));
      };
      const RigPoint a = carried(limb.a);
      const RigPoint b = carried(limb.b);
      const double depth_mm = std::min(camera.depth_mm(a), camera.depth_mm(b));
      if (depth_mm < 20) continue;
      const double scale = camera.focal_px() / depth_mm / reduced;
      const int thickness = std::max(1, cvRound((limb.a_radius_mm + limb.b_radius_mm) * scale));
      const auto pixel = [&](const RigPoint& p) {
        const ImagePoint image = camera.project(p);
        return cv::Point(cvRound(std::clamp(image.u_px / reduced, -2000.0, 2000.0)),
                         cvRound(std::clamp(image.v_px / reduced, -2000.0, 2000.0)));
      };
      cv::line(plane.density, pixel(a), pixel(b), cv::Scalar::all(1), std::min(thickness, 2000));
      const int around = thickness / 2 + cvRound(3 * plane.softness_px);
      plane.box |= cv::Rect(pixel(a), cv::Size(1, 1)) | cv::Rect(pixel(b), cv::Size(1, 1));
      plane.box |= cv::Rect(plane.box.x - around / 2, plane.box.y - around / 2, plane.box.width + around,
                            plane.box.height + around);
    }
  }
}

cv::Rect HandShadow::finish(cv::Mat& factor) {
  const cv::Rect all({0, 0}, planes_[0].density.size());
  const cv::Rect box = (planes_[0].box | planes_[1].box) & all;
  if (box.empty()) return {};
  sum_.create(box.size(), CV_32FC1);
  sum_ = 1.0F;
  for (Plane& plane : planes_) {
    cv::Mat density = plane.density(box);
    const int reach = std::max(1, cvRound(plane.softness_px));
    for (int pass = 0; pass < 2; ++pass)
      cv::blur(density, density, {2 * reach + 1, 2 * reach + 1}, {-1, -1}, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    for (int row = 0; row < box.height; ++row) {
      const float* shadow = density.ptr<float>(row);
      const float* takes = plane.takes.ptr<float>(row + box.y) + box.x;
      float* sum = sum_.ptr<float>(row);
      for (int column = 0; column < box.width; ++column)
        sum[column] *= 1 - strength_ * shadow[column] * takes[column];
    }
  }
  cv::sqrt(sum_, sum_);
  const cv::Rect full = cv::Rect(box.x * reduced, box.y * reduced, box.width * reduced, box.height * reduced);
  cv::resize(sum_, factor, full.size(), 0, 0, cv::INTER_LINEAR);
  const cv::Rect seen = full & cv::Rect({0, 0}, size_);
  factor = factor(cv::Rect(0, 0, seen.width, seen.height));
  return seen;
}

}  // namespace telehug
