// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/rig_scene.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "capture/virtual_rig/mirror_blur.hpp"
#include "capture/virtual_rig/surroundings.hpp"

namespace telehug {
namespace {

const cv::Vec3f upwards{0, -1, 0};
const cv::Vec3f to_user{0, 0, 1};
struct Sample {
  Light own;
  cv::Vec3f screen;  // place on it, and its share
  Light mirrored;    // times the reflectance
  float reflectance = 0;
  float height_mm = 0;  // of what is mirrored, above the screen
  int surfaces = 0;     // own and mirrored one: where they change an edge runs
};

class SceneRenderer {
 public:
  SceneRenderer(const VirtualRigSettings& settings, const PinholeCamera& camera)
      : settings_(settings),
        camera_(camera),
        surroundings_(settings),
        lighting_(settings.light),
        haze_(lighting_.on(to_user) * static_cast<float>(settings.coat.haze)),
        bezel_front_(product(linear(settings.bezel_tint), lighting_.on(to_user, 0.9F))),
        bezel_edge_(product(linear(settings.bezel_tint), lighting_.on(upwards, 0.85F))) {}

  [[nodiscard]] Sample look(double u_px, double v_px) const {
    const RigPoint& eye = camera_.position_mm();
    const RigPoint ray = camera_.ray(u_px, v_px);
    if (const auto bezel = look_at_bezel(eye, ray)) return plain(*bezel);
    if (ray[2] < 0) {
      const ScreenSize& screen = settings_.screen;
      const RigPoint p = eye + ray * (-eye[2] / ray[2]);
      const double bezel_mm = settings_.bezel_mm;
      if (p[0] >= -bezel_mm && p[0] <= screen.width_mm + bezel_mm && p[1] >= -bezel_mm && p[1] <= screen.height_mm) {
        if (p[0] < 0 || p[0] > screen.width_mm || p[1] < 0) return plain({bezel_front_, Surface::frame, 0});
        return screen_at(p, ray);
      }
    }
    return plain(surroundings_.look(eye, ray));
  }

 private:
  static Sample plain(const Seen& seen) { return {seen.light, {}, {}, 0, 0, static_cast<int>(seen.surface)}; }

  // The lower part of the frame: its front and the edge that looks up at the camera.
  [[nodiscard]] std::optional<Seen> look_at_bezel(const RigPoint& from, const RigPoint& ray) const {
    const ScreenSize& screen = settings_.screen;
    const double bezel_mm = settings_.bezel_mm;
    if (ray[1] <= 0) return std::nullopt;
    const double edge_t = (screen.height_mm - from[1]) / ray[1];
    const RigPoint edge = from + ray * edge_t;
    const bool across = edge[0] >= -bezel_mm && edge[0] <= screen.width_mm + bezel_mm;
    if (across && edge_t > 0 && edge[2] >= 0 && edge[2] <= settings_.bezel_raised_mm) {
      return Seen{bezel_edge_, Surface::bezel_edge, edge_t};
    }
    if (ray[2] >= 0) return std::nullopt;
    const double front_t = (settings_.bezel_raised_mm - from[2]) / ray[2];
    const RigPoint front = from + ray * front_t;
    const bool on_front = front[0] >= -bezel_mm && front[0] <= screen.width_mm + bezel_mm &&
                          front[1] > screen.height_mm && front[1] <= screen.height_mm + bezel_mm;
    if (on_front) return Seen{bezel_front_, Surface::bezel_front, front_t};
    return std::nullopt;
  }

  [[nodiscard]] Sample screen_at(const RigPoint& p, const RigPoint& ray) const {
    const RigPoint back(ray[0], ray[1], -ray[2]);
    auto seen = look_at_bezel(p, back);
    if (!seen) seen = surroundings_.look(p, back);
    const auto cosine = static_cast<float>(-ray[2] / cv::norm(ray));
    Sample sample;
    sample.own = haze_;
    sample.screen = {static_cast<float>(p[0]), static_cast<float>(p[1]), 1};
    sample.reflectance = static_cast<float>(settings_.coat.mirror) * fresnel(cosine);
    sample.mirrored = seen->light * sample.reflectance;
    sample.height_mm = static_cast<float>(seen->distance * back[2]);
    sample.surfaces = static_cast<int>(Surface::screen) + 16 * static_cast<int>(seen->surface);
    return sample;
  }

  const VirtualRigSettings& settings_;
  const PinholeCamera& camera_;
  Surroundings surroundings_;
  RoomLighting lighting_;
  Light haze_;
  Light bezel_front_;
  Light bezel_edge_;
};

class Canvas {
 public:
  Canvas(const SceneRenderer& renderer, cv::Size size)
      : renderer_(renderer),
        own(size, CV_32FC3),
        screen(size, CV_32FC3),
        mirrored(size, CV_32FC3),
        reflectance(size, CV_32FC1),
        height(size, CV_32FC1),
        surfaces(size, CV_8UC1) {}

  void render() {
    for (int v = 0; v < own.rows; ++v) {
      for (int u = 0; u < own.cols; ++u)
        store(v, u, renderer_.look(u, v));
    }
    smooth_edges();
  }

 private:
  void store(int v, int u, const Sample& sample) {
    own.at<Light>(v, u) = sample.own;
    screen.at<cv::Vec3f>(v, u) = sample.screen;
    mirrored.at<Light>(v, u) = sample.mirrored;
    reflectance.at<float>(v, u) = sample.reflectance;
    height.at<float>(v, u) = sample.height_mm;
    surfaces.at<uchar>(v, u) = static_cast<uchar>(sample.surfaces);
  }

  // Pixels beside which something else is seen get the mean of 4 x 4 rays.
  void smooth_edges() {
    cv::Mat least;
    cv::Mat most;
    cv::erode(surfaces, least, {});
    cv::dilate(surfaces, most, {});
    for (int v = 0; v < own.rows; ++v) {
      for (int u = 0; u < own.cols; ++u) {
        if (least.at<uchar>(v, u) == most.at<uchar>(v, u)) continue;
        Sample mean;
        mean.surfaces = surfaces.at<uchar>(v, u);
        mean.height_mm = height.at<float>(v, u);
        for (int i = 0; i < 16; ++i) {
          const Sample sample = renderer_.look(u + (i % 4 - 1.5) / 4, v + (static_cast<double>(i / 4) - 1.5) / 4);
          mean.own += sample.own * (1.0F / 16);
          mean.screen += cv::Vec3f(sample.screen[0], sample.screen[1], 1) * (sample.screen[2] / 16);
          mean.mirrored += sample.mirrored * (1.0F / 16);
          mean.reflectance += sample.reflectance / 16;
        }
        if (mean.screen[2] > 0)
          mean.screen = {mean.screen[0] / mean.screen[2], mean.screen[1] / mean.screen[2], mean.screen[2]};
        store(v, u, mean);
      }
    }
  }

  const SceneRenderer& renderer_;

 public:
  cv::Mat own;
  cv::Mat screen;
  cv::Mat mirrored;
  cv::Mat reflectance;
  cv::Mat height;
  cv::Mat surfaces;
};

// Divides by the reflectance what came multiplied with it, and blurs it.
cv::Mat blurred_mirror(const Canvas& canvas, const VirtualRigSettings& settings) {
  PictureLayer layer{cv::Rect({0, 0}, canvas.own.size()), cv::Mat(canvas.own.size(), CV_32FC4), canvas.height, {}};
  layer.columns.assign(static_cast<std::size_t>(canvas.own.rows), {0, canvas.own.cols});
  cv::Mat& image = layer.image;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const float reflectance = canvas.reflectance.at<float>(v, u);
      const Light light = reflectance > 0 ? canvas.mirrored.at<Light>(v, u) * (1 / reflectance) : Light{};
      image.at<cv::Vec4f>(v, u) = {light[0], light[1], light[2], reflectance > 0 ? 1.0F : 0.0F};
    }
  }
  MirrorBlur(settings.coat.roughness_deg, settings.focal_px, settings.camera.position_mm[2]).apply(layer);
  cv::Mat mirrored(image.size(), CV_32FC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const auto& pixel = image.at<cv::Vec4f>(v, u);
      const float share = pixel[3] > 1e-3F ? 1 / pixel[3] : 0;
      mirrored.at<Light>(v, u) = Light{pixel[0], pixel[1], pixel[2]} * share;
    }
  }
  return mirrored;
}

}  // namespace

float fresnel(float cosine) {
  constexpr float index = 1.5F;
  const float inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
  const float across = (cosine - index * inside) / (cosine + index * inside);
  const float along = (inside - index * cosine) / (inside + index * cosine);
  return (across * across + along * along) / 2;
}

RigScene render_scene(const VirtualRigSettings& settings, const PinholeCamera& camera) {
  const SceneRenderer renderer(settings, camera);
  Canvas canvas(renderer, {settings.image.width_px, settings.image.height_px});
  canvas.render();
  RigScene scene;
  scene.mirrored = blurred_mirror(canvas, settings);
  scene.own = canvas.own;
  scene.screen = canvas.screen;
  scene.reflectance = canvas.reflectance;
  scene.surface = canvas.surfaces & 15;
  return scene;
}

bool same_scene(const VirtualRigSettings& a, const VirtualRigSettings& b) {
  const auto same_size = [](const auto& one, const auto& other) {
    return one.width_px == other.width_px && one.height_px == other.height_px;
  };
  return a.screen.width_mm == b.screen.width_mm && a.screen.height_mm == b.screen.height_mm &&
         same_size(a.image, b.image) && a.focal_px == b.focal_px && a.distortion_k1 == b.distortion_k1 &&
         a.camera == b.camera && a.bezel_mm == b.bezel_mm && a.bezel_raised_mm == b.bezel_raised_mm &&
         a.bezel_tint == b.bezel_tint && a.desk_below_mm == b.desk_below_mm && a.coat == b.coat && a.light == b.light &&
         a.desk == b.desk;
}

}  // namespace telehug
