// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_controls.hpp"

#include <fmt/core.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>

#include "capture/webcam_device.hpp"

namespace telehug {
namespace {

bool is_a_number(std::uint32_t type) {
  return type == V4L2_CTRL_TYPE_INTEGER || type == V4L2_CTRL_TYPE_BOOLEAN || type == V4L2_CTRL_TYPE_MENU ||
         type == V4L2_CTRL_TYPE_INTEGER_MENU;
}

template <std::size_t size>
std::string text_of(const __u8 (&name)[size]) {
  const char* text = reinterpret_cast<const char*>(name);
  return {text, strnlen(text, size)};
}

}  // namespace

Status CameraControls::open(const std::string& device) {
  close();
  device_ = device;
  fd_ = calls_.open(device);
  if (fd_ < 0) return webcam_failure(device, "opened", fd_);
  return Done{};
}

void CameraControls::close() {
  if (fd_ >= 0) calls_.close(fd_);
  fd_ = -1;
}

std::vector<CameraControl> CameraControls::list() {
  std::vector<CameraControl> controls;
  v4l2_queryctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (calls_.ioctl(fd_, VIDIOC_QUERYCTRL, &query) == 0) {
    constexpr std::uint32_t fixed =
        V4L2_CTRL_FLAG_DISABLED | V4L2_CTRL_FLAG_READ_ONLY | V4L2_CTRL_FLAG_GRABBED | V4L2_CTRL_FLAG_WRITE_ONLY;
    const auto now = is_a_number(query.type) && (query.flags & fixed) == 0 ? value(query.id) : std::nullopt;
    if (now) {
      controls.push_back({query.id, text_of(query.name), query.minimum, query.maximum, query.step, query.default_value,
                          *now, (query.flags & V4L2_CTRL_FLAG_INACTIVE) != 0});
    }
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  return controls;
}

std::optional<std::int32_t> CameraControls::value(std::uint32_t id) {
  v4l2_control control{};
  control.id = id;
  if (calls_.ioctl(fd_, VIDIOC_G_CTRL, &control) < 0) return std::nullopt;
  return control.value;
}

Status CameraControls::set(const ControlValue& wanted) {
  v4l2_control control{};
  control.id = wanted.id;
  control.value = wanted.value;
  int code = calls_.ioctl(fd_, VIDIOC_S_CTRL, &control);
  if (code == -ENODEV || code == -ENXIO || code == -EBADF) {
    if (const Status opened = open(device_); !opened) return opened;
    code = calls_.ioctl(fd_, VIDIOC_S_CTRL, &control);
  }
  if (code >= 0) return Done{};
  return Error{
      fmt::format("{} refuses setting 0x{:08x} = {} ({})", device_, wanted.id, wanted.value, std::strerror(-code))};
}

}  // namespace telehug
