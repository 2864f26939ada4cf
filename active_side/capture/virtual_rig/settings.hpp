// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "capture/virtual_rig/disturbance.hpp"
#include "capture/virtual_rig/hand_looks.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/touch_script.hpp"
#include "common/units.hpp"

namespace telehug {

// Blue, green, red as a picture shows them in full white light, 0 to 255.
using Tint = cv::Vec3d;

// What is on the screen when no picture is given.
enum class ScreenContent { gradient, black, white, chat, photo, desktop };

// What moves in a part of the screen, from picture to picture of a script.
enum class ScreenMotion { still, scrolling, fading, rectangle, flashing };

// The light of the room. What lies open is as bright as its own tint says when `level` is 1.
struct RoomLight {
  double level = 1;
  cv::Vec3d colour{1, 1, 1};             // blue, green, red; warm light: {0.7, 0.9, 1.1}
  cv::Vec3d towards{0.15, -0.83, 0.53};  // the lamp, in the rig frame (-y: above)
  double directed = 0.22;                // share that comes from there, the rest comes from all sides
  double contact_shade = 0;     // share that skin loses where it meets the screen, as other fingers keep light away
  double contact_shade_mm = 3;  // at this distance from the screen e times less

  bool operator==(const RoomLight&) const = default;
};

// How the screen's surface reflects. Bare glass: mirror 1, roughness 0.
struct ScreenCoat {
  double mirror = 0.3;       // as a share of what bare glass mirrors (Fresnel), 0 to 1
  double roughness_deg = 2;  // standard deviation of the surface's tilt: 0.1 glossy, 6 matt
  double haze = 0.004;       // share of the room's light that it scatters (a black screen's grey), linear

  bool operator==(const ScreenCoat&) const = default;
};

enum class DeskKind { plain, wood, stone };

struct DeskLooks {
  DeskKind kind = DeskKind::plain;
  Tint tint{158, 152, 142};
  double foot_half_width_mm = 95;  // the monitor's foot; 0: none
  double foot_front_mm = 120;      // how far it reaches towards the user
  Tint foot_tint{70, 66, 64};
  bool keyboard = false;
  bool cup = false;
  std::uint64_t seed = 1;  // of the grain and of where things lie

  bool operator==(const DeskLooks&) const = default;
};

// What lens and electronics make of the light.
struct SensorLooks {
  double exposure = 1;         // 1: a lit white sheet is white
  double auto_exposure = 0;    // 0: none; 1: every picture is as bright as `target_tone` on average
  double target_tone = 110;    // 0 to 255
  double exposure_spread = 0;  // standard deviation of its logarithm from picture to picture
  double blur_px = 0.8;        // standard deviation of the lens' blur
  double sharpening = 0;       // webcams: 0.3 to 1.5 times what a blur of 1 px takes away is added
  double shutter_s = 0;        // how long it is open: hands that move are blurred; their truth is that of its middle
  int jpeg_quality = 0;        // 1 to 100: pictures go through a JPEG; 0: they don't
};

// Everything that the pictures of a virtual rig follow from: two rigs with the same settings give the same pictures.
struct VirtualRigSettings {
  ScreenSize screen{380, 300, 1280, 1024};
  double bezel_mm = 20;          // width of the frame around the picture
  double bezel_raised_mm = 4.5;  // how far its lower part stands out in front of the screen
  Tint bezel_tint{46, 44, 44};
  double desk_below_mm = 90;  // from the screen's lower edge to the desk
  ImageSize image{1280, 720};
  double focal_px = 1100;
  double distortion_k1 = 0;           // of the lens, see PinholeCamera
  CameraPose camera{{190, -15, 50}};  // above the middle of the screen's upper edge, looking straight down
  ScreenCoat coat;
  RoomLight light;
  DeskLooks desk;
  SensorLooks sensor;
  HandLooks hand;
  double noise_sd = 3;     // of the sensor, in grey levels
  std::uint64_t seed = 1;  // of noise, exposures and drawn screen contents
  double fps = 30;
  bool real_time = true;  // false: as fast as it is read
  bool repeat = true;     // play the script again and again; false: end after it
  ScreenContent content = ScreenContent::gradient;
  ScreenMotion motion = ScreenMotion::still;
  double screen_luminance = 0.75;  // of white on the screen, seen at the grazing angle of the camera, linear
  cv::Mat screen_picture;          // CV_8UC3, shown over the whole screen; empty: `content`
  TouchScript script;              // empty: default_script(screen)
  std::vector<Disturbance> disturbances;
};

}  // namespace telehug
