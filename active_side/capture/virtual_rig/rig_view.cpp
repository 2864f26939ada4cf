// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/rig_view.hpp"

#include <algorithm>

#include "capture/virtual_rig/screen_content.hpp"
#include "capture/virtual_rig/surroundings.hpp"

namespace telehug {
namespace {

cv::Rect box_of_screen(const cv::Mat& surface) {
  cv::Rect box;
  for (int v = 0; v < surface.rows; ++v) {
    const auto* row = surface.ptr<uchar>(v);
    const uchar* end = row + surface.cols;
    const uchar* first = std::find(row, end, static_cast<uchar>(Surface::screen));
    if (first == end) continue;
    box |= cv::Rect(static_cast<int>(first - row), v, static_cast<int>(end - first), 1);
  }
  return box;
}

}  // namespace

std::shared_ptr<RigView> make_view(const VirtualRigSettings& settings, const cv::Mat& shown, Development& development) {
  const PinholeCamera camera(settings.camera, settings.focal_px, settings.image, settings.distortion_k1);
  RigScene scene = render_scene(settings, camera, shown);
  // Half the memory of floats: reading it is what takes the time when a hand is composed with it.
  cv::Mat light(scene.own.size(), CV_16UC3);
  cv::Mat coded(scene.own.size(), CV_16UC3);
  const cv::Rect all({0, 0}, light.size());
  development.lens().code(all, all, coded, [&](int v, Light* row) {
    const Light* own = scene.own.ptr<Light>(v);
    const Light* mirrored = scene.mirrored.ptr<Light>(v);
    const float* reflectance = scene.reflectance.ptr<float>(v);
    for (int u = 0; u < light.cols; ++u)
      row[u] = own[u] + mirrored[u] * reflectance[u];
    root_coded(row->val, 3 * light.cols, light.ptr<std::uint16_t>(v));
  });
  const cv::Rect screen_box = box_of_screen(scene.surface);
  HandShadow shadow(settings, scene.surface);
  return std::make_shared<RigView>(
      RigView{camera, RoomLighting(settings.light), std::move(scene), screen_box, light, coded, std::move(shadow)});
}

std::shared_ptr<RigView> make_view(const VirtualRigSettings& settings, Development& development) {
  return make_view(settings,
                   settings.screen_picture.empty()
                       ? draw_screen_content(settings.content, settings.screen, settings.seed)
                       : settings.screen_picture,
                   development);
}

}  // namespace telehug
