// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "capture/virtual_rig/picture_layer.hpp"
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

void HandShadow::finish() {
  const cv::Size size = planes_[0].density.size();
  columns_.assign(static_cast<std::size_t>(size.height), {0, 0});
  const cv::Rect box = (planes_[0].box | planes_[1].box) & cv::Rect({0, 0}, size);
  if (box.empty()) return;
  factor_.create(size, CV_32FC1);
  factor_ = 1.0F;
  for (Plane& plane : planes_) {
    cv::Mat density = plane.density(box);
    const int reach = std::max(1, cvRound(plane.softness_px));
    for (int pass = 0; pass < 2; ++pass)
      cv::blur(density, density, {2 * reach + 1, 2 * reach + 1}, {-1, -1}, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    for (int row = box.y; row < box.y + box.height; ++row) {
      const float* shadow = plane.density.ptr<float>(row);
      const float* takes = plane.takes.ptr<float>(row);
      float* factor = factor_.ptr<float>(row);
      for (int column = box.x; column < box.x + box.width; ++column)
        factor[column] *= 1 - strength_ * shadow[column] * takes[column];
    }
  }
  cv::sqrt(factor_, factor_);
  const auto shaded = [](float factor) { return factor < 0.998F; };
  for (int row = box.y; row < box.y + box.height; ++row) {
    const float* begin = factor_.ptr<float>(row);
    const float* end = begin + size.width;
    const float* first = std::find_if(begin, end, shaded);
    while (end > first && !shaded(end[-1]))
      --end;
    columns_[static_cast<std::size_t>(row)] = {static_cast<int>(first - begin), static_cast<int>(end - begin)};
  }
}

// Pixel v lies (v + 0.5) / reduced - 0.5 rows down; its row of `factor_` and the next one are mixed.
cv::Range HandShadow::columns(int v) const {
  const auto rows = static_cast<int>(columns_.size());
  const int above = std::clamp((v + reduced / 2) / reduced - 1, 0, rows - 1);
  const cv::Range both = joined(columns_[static_cast<std::size_t>(above)],
                                columns_[static_cast<std::size_t>(std::min(above + 1, rows - 1))]);
  if (both.empty()) return {};
  return {std::max(0, both.start - 1) * reduced, std::min(size_.width / reduced, both.end + 1) * reduced};
}

void HandShadow::factors(int v, float* factor) const {
  const cv::Range shaded = columns(v);
  const float down =
      std::clamp((static_cast<float>(v) + 0.5F) / reduced - 0.5F, 0.0F, static_cast<float>(factor_.rows - 1));
  const int row = std::min(static_cast<int>(down), factor_.rows - 2);
  const float* above = factor_.ptr<float>(row);
  const float* below = factor_.ptr<float>(row + 1);
  const float of_below = down - static_cast<float>(row);
  const int first = shaded.start / reduced - 1;  // one more at either side for the mixing
  const int end = (shaded.end - 1) / reduced + 2;
  std::vector<float>& between = between_;
  between.resize(static_cast<std::size_t>(end - first));
  for (int i = first; i < end; ++i) {
    const int column = std::clamp(i, 0, factor_.cols - 1);
    between[static_cast<std::size_t>(i - first)] = above[column] + (below[column] - above[column]) * of_below;
  }
  static_assert(reduced == 4);
  for (int i = 0; i < shaded.size() / reduced; ++i) {  // columns() are multiples of four
    const float* here = &between[static_cast<std::size_t>(i + shaded.start / reduced - first)];
    const float before = here[0] - here[-1];
    const float behind = here[1] - here[0];
    float* const four = factor + 4 * static_cast<std::ptrdiff_t>(i);
    four[0] = here[0] - 0.375F * before;
    four[1] = here[0] - 0.125F * before;
    four[2] = here[0] + 0.125F * behind;
    four[3] = here[0] + 0.375F * behind;
  }
}

}  // namespace telehug
