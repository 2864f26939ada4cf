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

// Of all pixels that look at the window, wider by what the lens makes of them.
cv::Rect box_of_window(const RigScene& scene, const cv::Rect2f& window) {
  cv::Rect box;
  if (window.empty()) return box;
  for (int v = 0; v < scene.screen.rows; ++v) {
    const auto* place = scene.screen.ptr<cv::Vec3f>(v);
    for (int u = 0; u < scene.screen.cols; ++u) {
      if (place[u][2] > 0 && window.contains({place[u][0], place[u][1]})) box |= cv::Rect(u, v, 1, 1);
    }
  }
  if (box.empty()) return box;
  constexpr int margin = Lens::margin_px;
  return cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
         cv::Rect({0, 0}, scene.screen.size());
}

}  // namespace

void develop(RigView& view, const cv::Rect& box, Development& development) {
  const RigScene& scene = *view.scene;
  constexpr int margin = Lens::margin_px;
  const cv::Rect around = cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
                          cv::Rect({0, 0}, scene.own.size());
  development.lens().code(around, box, view.coded, [&](int v, Light* row) {
    const Light* own = scene.own.ptr<Light>(v) + around.x;
    const auto* screen = scene.screen.ptr<cv::Vec3f>(v) + around.x;
    const Light* mirrored = scene.mirrored.ptr<Light>(v) + around.x;
    const float* reflectance = scene.reflectance.ptr<float>(v) + around.x;
    for (int u = 0; u < around.width; ++u) {
      row[u] = own[u] + mirrored[u] * reflectance[u];
      if (screen[u][2] > 0) row[u] += view.shown.at(screen[u][0], screen[u][1]) * screen[u][2];
    }
    root_coded(row->val, 3 * around.width,
               view.light.ptr<std::uint16_t>(v) + 3 * static_cast<std::ptrdiff_t>(around.x));
  });
}

std::shared_ptr<RigView> make_view(const VirtualRigSettings& settings, const cv::Mat& shown, Development& development,
                                   const std::shared_ptr<RigView>& other) {
  const PinholeCamera camera(settings.camera, settings.focal_px, settings.image, settings.distortion_k1);
  const std::shared_ptr<const RigScene> scene = other && same_scene(other->settings, settings)
                                                    ? other->scene
                                                    : std::make_shared<RigScene>(render_scene(settings, camera));
  const ShownPicture picture(settings, shown);
  const cv::Size size = scene->own.size();
  // Light as 16-bit roots is half the memory of floats: reading it is what takes the time when a hand is composed with
  // it.
  auto view = std::make_shared<RigView>(RigView{camera, RoomLighting(settings.light), settings, scene, picture,
                                                box_of_screen(scene->surface), box_of_window(*scene, picture.window()),
                                                cv::Mat(size, CV_16UC3), cv::Mat(size, CV_16UC3),
                                                HandShadow(settings, scene->surface)});
  develop(*view, cv::Rect({0, 0}, size), development);
  return view;
}

std::shared_ptr<RigView> make_view(const VirtualRigSettings& settings, Development& development,
                                   const std::shared_ptr<RigView>& other) {
  return make_view(settings,
                   settings.screen_picture.empty()
                       ? draw_screen_content(settings.content, settings.screen, settings.seed)
                       : settings.screen_picture,
                   development, other);
}

}  // namespace telehug
