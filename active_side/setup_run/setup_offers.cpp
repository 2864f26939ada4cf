// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_offers.hpp"

#include <algorithm>
#include <cstdlib>

#include "capture/webcam_device.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

// One webcam has one name, be it given by its device or as the first there is.
std::string source_of(const CameraConfig& configured) {
  if (configured.source != "webcam") return configured.source;
  return "webcam:" + (configured.device.empty() ? first_webcam_device() : configured.device);
}

}  // namespace

std::vector<OfferedCamera> offered_cameras(const CameraConfig& configured, const std::filesystem::path& webcams) {
  std::vector<OfferedCamera> cameras;
  for (const WebcamDevice& webcam : list_webcams(webcams))
    cameras.push_back({"webcam:" + webcam.path, webcam.name});
  const std::string source = source_of(configured);
  const auto plugged = std::ranges::find(cameras, source, &OfferedCamera::source);
  if (plugged != cameras.end()) {
    std::rotate(cameras.begin(), plugged, std::next(plugged));
  } else {
    cameras.insert(cameras.begin(), {source, source});
  }
  return cameras;
}

std::vector<SizedMonitor> monitors_of_display() {
  const char* display = std::getenv("DISPLAY");
  if (display == nullptr || *display == '\0') return {};
  const auto connection = X11Connection::open(display);
  return connection ? list_sized_x11_monitors(*connection) : std::vector<SizedMonitor>{};
}

Json offers_json(const std::vector<OfferedCamera>& cameras, const std::vector<SizedMonitor>& monitors) {
  Json offered = {{"cameras", Json::array()}, {"monitors", Json::array()}};
  for (const OfferedCamera& camera : cameras)
    offered["cameras"].push_back({{"source", camera.source}, {"name", camera.name}});
  for (const SizedMonitor& sized : monitors) {
    const cv::Rect& place = sized.monitor.place_px;
    offered["monitors"].push_back({{"name", sized.monitor.name},
                                   {"primary", sized.monitor.primary},
                                   {"x_px", place.x},
                                   {"y_px", place.y},
                                   {"width_px", place.width},
                                   {"height_px", place.height},
                                   {"width_mm", sized.size.width_mm},
                                   {"height_mm", sized.size.height_mm},
                                   {"size_from", name_of(sized.from)}});
  }
  return offered;
}

}  // namespace telehug
