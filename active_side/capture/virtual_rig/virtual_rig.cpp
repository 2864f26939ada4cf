// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/virtual_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "calibration/calibration_page.hpp"

namespace telehug {
namespace {

constexpr double margin_px = 8;           // a calibration point must lie this far inside the picture
constexpr double least_distance_mm = 12;  // between calibration points

VirtualRigSettings completed(VirtualRigSettings settings) {
  if (settings.script.touches.empty()) settings.script = default_script(settings.screen);
  const Status checked = check_virtual_rig(settings);
  if (!checked) throw std::invalid_argument(checked.error().message);
  settings.screen_picture = settings.screen_picture.clone();
  return settings;
}

cv::Mat plain(const ScreenSize& screen, uchar level) {
  return {screen.height_px, screen.width_px, CV_8UC3, cv::Scalar::all(level)};
}

// White dots of the calibration on a black screen.
cv::Mat dots_at(const std::vector<ScreenPoint>& points, const ScreenSize& screen) {
  cv::Mat shown = plain(screen, 0);
  const double x_px_per_mm = shown.cols / screen.width_mm;
  const double y_px_per_mm = shown.rows / screen.height_mm;
  const cv::Size2f size(static_cast<float>(calibration_dot_mm * x_px_per_mm),
                        static_cast<float>(calibration_dot_mm * y_px_per_mm));
  for (const ScreenPoint& point : points) {
    // A pixel's centre has whole coordinates in OpenCV, so the screen's edge lies half a pixel before 0.
    const cv::Point2f centre(static_cast<float>(point.x_mm * x_px_per_mm - 0.5),
                             static_cast<float>(point.y_mm * y_px_per_mm - 0.5));
    cv::ellipse(shown, {centre, size, 0}, cv::Scalar::all(255), cv::FILLED, cv::LINE_AA);
  }
  return shown;
}

}  // namespace

Status check_virtual_rig(const VirtualRigSettings& s) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!within(s.screen.width_mm, 50, 5000) || !within(s.screen.height_mm, 50, 5000)) {
    return Error{"virtual rig: the screen must be 50 to 5000 mm wide and high"};
  }
  if (s.screen.width_px < 1 || s.screen.height_px < 1 || s.screen.width_px > 8192 || s.screen.height_px > 8192) {
    return Error{"virtual rig: the screen must have 1 to 8192 pixels a side"};
  }
  if (s.image.width_px < 64 || s.image.height_px < 64 || s.image.width_px > 8192 || s.image.height_px > 8192) {
    return Error{"virtual rig: the picture must have 64 to 8192 pixels a side"};
  }
  if (!within(s.focal_px, 50, 50'000)) return Error{"virtual rig: focal_px must be 50 to 50000"};
  if (!within(s.fps, 0.1, 1000)) return Error{"virtual rig: fps must be 0.1 to 1000"};
  if (!within(s.bezel_mm, 0, 500) || !within(s.bezel_raised_mm, 0, s.camera.position_mm[2]) ||
      !within(s.desk_below_mm, 10, 2000)) {
    return Error{"virtual rig: bezel_mm must be 0 to 500, desk_below_mm 10 to 2000, the bezel lower than the camera"};
  }
  if (!within(s.distortion_k1, -0.2, 0.2)) return Error{"virtual rig: distortion_k1 must be -0.2 to 0.2"};
  if (s.hand.skin_tone < 1 || s.hand.skin_tone > 6) return Error{"virtual rig: skin_tone must be 1 to 6 (Fitzpatrick)"};
  if (!within(s.hand.finger_width_mm, 8, 30) || !within(s.hand.nail_mm, 0, 30)) {
    return Error{"virtual rig: fingers must be 8 to 30 mm wide, nails 0 to 30 mm long"};
  }
  if (!within(s.coat.mirror, 0, 1) || !within(s.coat.roughness_deg, 0, 20) || !within(s.coat.haze, 0, 1)) {
    return Error{"virtual rig: the coat's mirror and haze must be 0 to 1, its roughness 0 to 20 degrees"};
  }
  if (!within(s.light.level, 0, 100) || !within(s.light.directed, 0, 1) || !(cv::norm(s.light.towards) > 0)) {
    return Error{"virtual rig: the light's level must be 0 to 100, its directed share 0 to 1, its direction not 0"};
  }
  if (!within(s.sensor.exposure, 0.001, 1000) || !within(s.sensor.exposure_spread, 0, 2) ||
      !within(s.sensor.auto_exposure, 0, 1) || !within(s.sensor.target_tone, 1, 254) ||
      !within(s.sensor.blur_px, 0, 2.4) || !within(s.sensor.sharpening, 0, 5) || !within(s.sensor.shutter_s, 0, 1) ||
      s.sensor.jpeg_quality < 0 || s.sensor.jpeg_quality > 100) {
    return Error{
        "virtual rig: exposure must be 0.001 to 1000, its spread 0 to 2, auto_exposure 0 to 1, target_tone 1 to 254, "
        "blur_px 0 to 2.4, sharpening 0 to 5, shutter_s 0 to 1, "
        "jpeg_quality 0 to 100"};
  }
  if (!within(s.noise_sd, 0, 50)) return Error{"virtual rig: noise_sd must be 0 to 50"};
  if (!within(s.camera.position_mm[2], 1, 1000) || !within(s.camera.position_mm[1], -1000, 0)) {
    return Error{"virtual rig: the camera must be 1 to 1000 mm in front of the screen, at its upper edge or above"};
  }
  for (const double angle : {s.camera.pitch_deg, s.camera.yaw_deg, s.camera.roll_deg}) {
    if (!within(angle, -30, 30)) return Error{"virtual rig: the camera's angles must be -30 to 30 degrees"};
  }
  if (!s.screen_picture.empty() && s.screen_picture.type() != CV_8UC3) {
    return Error{"virtual rig: the screen's picture must be 8-bit BGR"};
  }
  for (const Disturbance& disturbance : s.disturbances) {
    if (!(disturbance.end_s > disturbance.begin_s) || !std::isfinite(disturbance.amount)) {
      return Error{fmt::format("virtual rig: the disturbance at {} s has no end after it", disturbance.begin_s)};
    }
  }
  double free_from_s = 0;
  for (const ScriptedTouch& touch : s.script.touches) {
    if (!(touch.begin_s - approach_s >= free_from_s) || !(touch.end_s >= touch.begin_s)) {
      return Error{
          fmt::format("virtual rig: the touch at {} s begins before the one before it is over", touch.begin_s)};
    }
    for (const ScreenPoint& p : {touch.from, touch.to}) {
      if (!within(p.x_mm, 0, s.screen.width_mm) || !within(p.y_mm, 0, s.screen.height_mm)) {
        return Error{fmt::format("virtual rig: the touch at {} s is not on the screen", touch.begin_s)};
      }
    }
    free_from_s = touch.end_s + approach_s;
  }
  if (!s.script.touches.empty() && !(s.script.length_s >= free_from_s)) {
    return Error{"virtual rig: the script is over before its last touch"};
  }
  return Done{};
}

VirtualRig::VirtualRig(VirtualRigSettings settings, const Clock& clock, SleepUntil sleep)
    : settings_(completed(std::move(settings))),
      pace_(settings_.fps, settings_.real_time, clock, std::move(sleep)),
      pictures_(settings_) {}

Status VirtualRig::open() {
  if (open_) return Done{};
  open_ = true;
  pace_.open();
  return Done{};
}

void VirtualRig::close() {
  open_ = false;
  pace_.close();
}

ReadOutcome VirtualRig::read(Frame& frame, Duration timeout) {
  const Timestamp deadline = pace_.now() + timeout;
  if (!open_) {
    last_error_ = "the virtual rig is closed";
    pace_.wait(deadline);
    return ReadOutcome::lost;
  }
  if (!settings_.repeat && static_cast<double>(pace_.next()) / settings_.fps > settings_.script.length_s) {
    return ReadOutcome::ended;
  }
  const auto number = pace_.wait_for_picture(deadline);
  if (!number) return ReadOutcome::timeout;
  pictures_.draw(hands(*number), script_time_s(*number), *number, frame.bgr);
  frame.sequence = *number;
  frame.time = pace_.time_of(*number);
  return ReadOutcome::frame;
}

double VirtualRig::script_time_s(std::uint64_t sequence) const {
  const double time_s = static_cast<double>(sequence) / settings_.fps;
  return settings_.repeat ? std::fmod(time_s, settings_.script.length_s) : time_s;
}

std::vector<HandPose> VirtualRig::hands(std::uint64_t sequence) const {
  return hands_at(settings_.script, script_time_s(sequence));
}

VirtualTruth VirtualRig::truth(std::uint64_t sequence) const {
  const std::vector<HandPose> seen = hands(sequence);
  if (seen.empty()) return {};
  const HandPose& hand = seen.front();
  VirtualTruth truth;
  truth.contact = hand.finger.hover_mm <= 0;
  truth.screen = hand.finger.foot;
  if (!truth.contact) truth.hover_mm = hand.finger.hover_mm;
  if (hand.second) truth.second = hand.second->foot;
  return truth;
}

cv::Mat VirtualRig::picture_of(const cv::Mat& shown, const std::vector<HandPose>& hands) {
  RigRenderer renderer = pictures_.renderer();  // shares the noise, which takes longest to make
  renderer.show(shown);
  cv::Mat bgr;
  renderer.draw(hands, ~calibration_pictures_++, bgr);
  return bgr;
}

cv::Mat VirtualRig::picture_of_background() {
  return picture_of(plain(settings_.screen, 0), {});
}

cv::Mat VirtualRig::picture_of_triangle() {
  cv::Mat shown = plain(settings_.screen, 255);
  const int width = shown.cols;
  const int height = shown.rows;
  const std::vector<cv::Point> corners{
      {width / 2, height - 1}, {width * 2 / 5, height / 2}, {width * 3 / 5, height / 2}};
  cv::fillConvexPoly(shown, corners, cv::Scalar::all(0), cv::LINE_AA);
  return picture_of(shown, {});
}

cv::Mat VirtualRig::picture_of_marks() {
  return picture_of(dots_at(mark_points(settings_.screen), settings_.screen), {});
}

cv::Mat VirtualRig::picture_of_touch(const ScreenPoint& point, const HandPose& pose) {
  std::vector<HandPose> hands(1, pose);
  hands.front().finger = {point, 0};
  return picture_of(dots_at({point}, settings_.screen), hands);
}

std::vector<ScreenPoint> calibration_points(const VirtualRigSettings& settings) {
  const double width_mm = settings.screen.width_mm;
  const double height_mm = settings.screen.height_mm;
  std::vector<ScreenPoint> wanted{{0.5 * width_mm, 0.66 * height_mm}, {0.5 * width_mm + 30, 0.86 * height_mm}};
  for (const auto& [x, y] :
       {std::pair{0.41, 0.53}, {0.63, 0.53}, {0.24, 0.72}, {0.77, 0.72}, {0.18, 0.87}, {0.74, 0.87}, {0.34, 0.93}}) {
    wanted.push_back({x * width_mm, y * height_mm});
  }
  const PinholeCamera camera(settings.camera, settings.focal_px, settings.image, settings.distortion_k1);
  const auto seen = [&](const ScreenPoint& point) {
    const ImagePoint p = camera.project({point.x_mm, point.y_mm, 0});
    return p.u_px >= margin_px && p.v_px >= margin_px && p.u_px <= settings.image.width_px - margin_px &&
           p.v_px <= settings.image.height_px - margin_px;
  };
  const ScreenPoint well_seen{0.5 * width_mm, 0.88 * height_mm};
  std::vector<ScreenPoint> points;
  for (ScreenPoint point : wanted) {
    for (int step = 0; step < 30 && !seen(point); ++step)
      point = {point.x_mm + 0.1 * (well_seen.x_mm - point.x_mm), point.y_mm + 0.1 * (well_seen.y_mm - point.y_mm)};
    const bool apart = std::none_of(points.begin(), points.end(), [&](const ScreenPoint& other) {
      return std::hypot(point.x_mm - other.x_mm, point.y_mm - other.y_mm) < least_distance_mm;
    });
    if (apart && seen(point)) points.push_back(point);
  }
  return points;
}

}  // namespace telehug
