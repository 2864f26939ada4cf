// SPDX-License-Identifier: Apache-2.0
#include "screen_source.hpp"

#include <cstdlib>
#include <opencv2/core/types.hpp>
#include <optional>

#include "config/locator.hpp"
#include "screen/picture_grabber.hpp"

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

Result<std::unique_ptr<ScreenGrabber>> make_screen_grabber(const ActiveConfig& config, const Clock& clock) {
  const BodyMapConfig& map = config.body_map;
  const auto source = parse_screen_source(map.source);
  if (!source) return source.error();
  const auto region = parse_screen_region(map.region);
  if (!region) return region.error();
  using Grabber = std::unique_ptr<ScreenGrabber>;
  switch (resolve(source->kind, map)) {
    case ScreenSourceKind::picture: {
      PictureGrabberConfig picture;
      picture.path = map.picture;
      picture.view = rect_of(*region);
      return Grabber(std::make_unique<PictureGrabber>(picture, clock));
    }
    default:
      return Error{"not yet"};
  }
}

}  // namespace telehug
