// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/rig_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace telehug {
namespace {

using Colour = cv::Vec3d;  // blue, green, red, 0..255

const Colour bezel_colour{46, 44, 44};
const Colour bezel_edge{52, 50, 50};  // lit from above
const Colour foot_colour{70, 66, 64};
const Colour desk_colour{158, 152, 142};
const Colour nothing{18, 18, 18};
constexpr double grazing_brightness = 0.75;  // an LCD looks darker from the edge
const Colour coat_haze{16, 15, 15};          // room light that a matt coat scatters
constexpr double foot_half_width_mm = 95;
constexpr double foot_front_mm = 120;
constexpr double foot_thickness_mm = 8;

// Samples of a pixel, so that edges are smooth.
constexpr std::array<double, 2> subpixels{-0.25, 0.25};

struct Sample {
  Colour seen;
  Colour unmirrored;
  bool screen = false;
};

class SceneRenderer {
 public:
  SceneRenderer(const VirtualRigSettings& settings, const PinholeCamera& camera, const cv::Mat& shown)
      : settings_(settings), camera_(camera), shown_(shown) {}

  [[nodiscard]] Sample look(double u_px, double v_px) const {
    const RigPoint& eye = camera_.position_mm();
    const RigPoint ray = camera_.ray(u_px, v_px);
    const ScreenSize& screen = settings_.screen;
    const double bezel_mm = settings_.bezel_mm;
    if (ray[1] > 0 && ray[2] < 0) {
      const RigPoint wall = eye + ray * ((screen.height_mm - eye[1]) / ray[1]);
      const RigPoint front = eye + ray * ((settings_.bezel_raised_mm - eye[2]) / ray[2]);
      const bool across = wall[0] >= -bezel_mm && wall[0] <= screen.width_mm + bezel_mm;
      if (across && wall[2] >= 0 && wall[2] <= settings_.bezel_raised_mm) return {bezel_edge, bezel_edge, false};
      if (across && front[1] > screen.height_mm && front[1] <= screen.height_mm + bezel_mm) {
        return {bezel_colour, bezel_colour, false};
      }
    }
    if (ray[2] < 0) {
      const RigPoint p = eye + ray * (-eye[2] / ray[2]);
      if (p[0] >= -bezel_mm && p[0] <= screen.width_mm + bezel_mm && p[1] >= -bezel_mm && p[1] <= screen.height_mm) {
        if (p[0] < 0 || p[0] > screen.width_mm || p[1] < 0) return {bezel_colour, bezel_colour, false};
        const Colour own = content(p[0] / screen.width_mm, p[1] / screen.height_mm) * grazing_brightness + coat_haze;
        return {own + behind_monitor(p, {ray[0], ray[1], -ray[2]}) * settings_.mirror, own, true};
      }
    }
    const Colour colour = behind_monitor(eye, ray);
    return {colour, colour, false};
  }

 private:
  // Foot and desk.
  [[nodiscard]] Colour behind_monitor(const RigPoint& from, const RigPoint& ray) const {
    if (ray[1] <= 0) return nothing;
    const double desk_y_mm = settings_.screen.height_mm + settings_.desk_below_mm;
    const RigPoint foot = from + ray * ((desk_y_mm - foot_thickness_mm - from[1]) / ray[1]);
    if (std::abs(foot[0] - settings_.screen.width_mm / 2) < foot_half_width_mm && std::abs(foot[2]) < foot_front_mm) {
      return foot_colour;
    }
    const RigPoint desk = from + ray * ((desk_y_mm - from[1]) / ray[1]);
    const double grain = 1 + 0.03 * std::sin(0.11 * desk[2] + 0.7 * std::sin(0.013 * desk[0])) +
                         0.02 * std::sin(0.031 * desk[0] + 0.05 * desk[2]);
    const double shade = 0.75 + 0.25 * std::tanh((desk[2] + 30) / 60);  // less light behind the monitor
    return desk_colour * (grain * shade);
  }

  // Bilinear; `x` and `y` are shares of the screen.
  [[nodiscard]] Colour content(double x, double y) const {
    const double column = std::clamp(x * shown_.cols - 0.5, 0.0, shown_.cols - 1.0);
    const double row = std::clamp(y * shown_.rows - 0.5, 0.0, shown_.rows - 1.0);
    const int c0 = static_cast<int>(column);
    const int r0 = static_cast<int>(row);
    const int c1 = std::min(c0 + 1, shown_.cols - 1);
    const int r1 = std::min(r0 + 1, shown_.rows - 1);
    const double fc = column - c0;
    const double fr = row - r0;
    return (at(r0, c0) * (1 - fc) + at(r0, c1) * fc) * (1 - fr) + (at(r1, c0) * (1 - fc) + at(r1, c1) * fc) * fr;
  }
  [[nodiscard]] Colour at(int row, int column) const { return shown_.at<cv::Vec3b>(row, column); }

  const VirtualRigSettings& settings_;
  const PinholeCamera& camera_;
  const cv::Mat& shown_;
};

cv::Vec3b rounded(const Colour& colour) {
  return {cv::saturate_cast<uchar>(colour[0]), cv::saturate_cast<uchar>(colour[1]),
          cv::saturate_cast<uchar>(colour[2])};
}

}  // namespace

RigScene render_scene(const VirtualRigSettings& settings, const PinholeCamera& camera, const cv::Mat& shown) {
  const int rows = settings.image.height_px;
  const int cols = settings.image.width_px;
  RigScene scene{cv::Mat(rows, cols, CV_8UC3), cv::Mat(rows, cols, CV_8UC3), cv::Mat(rows, cols, CV_8UC1)};
  const SceneRenderer renderer(settings, camera, shown);
  constexpr double weight = 1.0 / (subpixels.size() * subpixels.size());
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < cols; ++u) {
      Colour seen;
      Colour unmirrored;
      int on_screen = 0;
      for (const double dv : subpixels) {
        for (const double du : subpixels) {
          const Sample sample = renderer.look(u + du, v + dv);
          seen += sample.seen * weight;
          unmirrored += sample.unmirrored * weight;
          on_screen += sample.screen ? 1 : 0;
        }
      }
      scene.picture.at<cv::Vec3b>(v, u) = rounded(seen);
      scene.unmirrored.at<cv::Vec3b>(v, u) = rounded(unmirrored);
      scene.is_screen.at<uchar>(v, u) = on_screen >= 2 ? 255 : 0;
    }
  }
  return scene;
}

}  // namespace telehug
