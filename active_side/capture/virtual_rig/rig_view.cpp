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
  cv::Mat light(scene.own.size(), CV_32FC3);
  for (int v = 0; v < light.rows; ++v) {
    const Light* own = scene.own.ptr<Light>(v);
    const Light* mirrored = scene.mirrored.ptr<Light>(v);
    const float* reflectance = scene.reflectance.ptr<float>(v);
    Light* sum = light.ptr<Light>(v);
    for (int u = 0; u < light.cols; ++u)
      sum[u] = own[u] + mirrored[u] * reflectance[u];
  }
  cv::Mat coded;
  development.code(light, coded);
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
