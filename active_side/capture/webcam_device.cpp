// SPDX-License-Identifier: Apache-2.0
#include "capture/webcam_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

namespace telehug {

Error webcam_failure(const std::string& device, const char* doing, int code) {
  switch (-code) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return Error{fmt::format("there is no webcam {}; plug it in or choose one of /dev/v4l/by-id", device)};
    case EACCES:
    case EPERM:
      return Error{
          fmt::format("{} must not be used by this user; add the user to the group 'video' (sudo usermod -aG "
                      "video USER) and log in again",
                      device)};
    case EBUSY:
      return Error{
          fmt::format("{} is used by another program; close that one (perhaps the video chat shows this "
                      "camera) or choose another webcam",
                      device)};
    case ENOTTY:
    case EINVAL:
      return Error{fmt::format("{} can't be {}: it is no webcam that telehug can use ({})", device, doing,
                               std::strerror(-code))};
    default:
      return Error{fmt::format("{} can't be {}: {}", device, doing, std::strerror(-code))};
  }
}

namespace {

// udev calls them usb-MAKER_MODEL_SERIAL-video-index0.
std::string name_in(std::string file) {
  if (file.starts_with("usb-")) file.erase(0, 4);
  file.resize(file.rfind("-video-index0"));
  std::ranges::replace(file, '_', ' ');
  return file;
}

}  // namespace

std::vector<WebcamDevice> list_webcams(const std::filesystem::path& folder) {
  std::vector<WebcamDevice> webcams;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with("-video-index0")) webcams.push_back({entry.path().string(), name_in(file)});
  }
  std::ranges::sort(webcams, {}, &WebcamDevice::path);
  return webcams;
}

std::string first_webcam_device() {
  const auto webcams = list_webcams();
  return webcams.empty() ? "/dev/video0" : webcams.front().path;
}

}  // namespace telehug
