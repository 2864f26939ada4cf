// SPDX-License-Identifier: Apache-2.0
#include "screen_source.hpp"

#include <chrono>
#include <cstdlib>
#include <opencv2/core/types.hpp>
#include <optional>

#include "capture/make_frame_source.hpp"
#include "config/locator.hpp"
#include "config/places.hpp"
#include "screen/frame_grabber.hpp"
#include "screen/picture_grabber.hpp"
#include "screen/recorded_screen_grabber.hpp"
#include "screen_portal/portal_grabber.hpp"
#include "screen_x11/x11_grabber.hpp"

namespace telehug {
namespace {

bool set_in_environment(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

ScreenSourceKind resolve(ScreenSourceKind kind, const BodyMapConfig& config) {
  if (kind != ScreenSourceKind::automatic) return kind;
  if (!config.picture.empty()) return ScreenSourceKind::picture;
  return set_in_environment("WAYLAND_DISPLAY") ? ScreenSourceKind::portal : ScreenSourceKind::x11;
}

std::optional<cv::Rect> rect_of(const std::optional<ScreenRegion>& region) {
  if (!region) return std::nullopt;
  return cv::Rect(region->x_px, region->y_px, region->width_px, region->height_px);
}

}  // namespace

std::string ignored_screen_keys(const BodyMapConfig& config) {
  const auto source = parse_screen_source(config.source);
  if (!source || resolve(source->kind, config) == ScreenSourceKind::x11) return "";
  if (config.window.empty() && config.monitor.empty()) return "";
  return "[body_map] window and monitor mean nothing here: only X11 knows windows and monitors by name.";
}

BodyMapStepConfig body_map_step_config(const BodyMapConfig& config, const std::optional<ScreenSize>& screen) {
  BodyMapStepConfig step;
  step.screen = screen;
  step.rules.hold = std::chrono::milliseconds(config.hold_ms);
  step.mirrored = config.mirrored;
  return step;
}

Result<std::unique_ptr<ScreenGrabber>> make_screen_grabber(const ActiveConfig& config, const Clock& clock) {
  const BodyMapConfig& map = config.body_map;
  const auto source = parse_screen_source(map.source);
  if (!source) return source.error();
  const auto region = parse_screen_region(map.region);
  if (!region) return region.error();
  using Grabber = std::unique_ptr<ScreenGrabber>;
  switch (resolve(source->kind, map)) {
    case ScreenSourceKind::picture: {
      if (map.picture.empty()) return Error{"which picture shows the remote person? Set body_map.picture"};
      PictureGrabberConfig picture;
      picture.path = map.picture;
      picture.view = rect_of(*region);
      return Grabber(std::make_unique<PictureGrabber>(picture, clock));
    }
    case ScreenSourceKind::camera: {
      CaptureSettings capture;
      capture.webcam_size = {1920, 1080};
      auto device = make_frame_source("webcam:" + source->place, capture, clock);
      if (!device) return device.error();
      return Grabber(std::make_unique<FrameGrabber>(
          *std::move(device), FrameGrabberConfig{.region = rect_of(*region), .live = true}, clock));
    }
    case ScreenSourceKind::recording:
      return Grabber(std::make_unique<RecordedScreenGrabber>(source->place, clock));
    case ScreenSourceKind::portal: {
      PortalGrabberConfig screen;
      screen.token_file = screen_consent_file();
      screen.region = rect_of(*region);
      return Grabber(std::make_unique<PortalGrabber>(screen, clock));
    }
    case ScreenSourceKind::automatic:
    case ScreenSourceKind::x11:
      break;
  }
  X11GrabberConfig screen;
  screen.monitor = map.monitor;
  screen.window = map.window;
  screen.region = rect_of(*region);
  return Grabber(std::make_unique<X11Grabber>(screen, clock));
}

}  // namespace telehug
