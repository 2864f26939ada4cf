// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "capture/v4l2_calls.hpp"
#include "common/result.hpp"

namespace telehug {

// A setting of a camera: V4L2_CID_... of linux/v4l2-controls.h.
struct ControlValue {
  std::uint32_t id = 0;
  std::int32_t value = 0;
  friend bool operator==(const ControlValue&, const ControlValue&) = default;
};
using ControlValues = std::vector<ControlValue>;

struct CameraControl {
  std::uint32_t id = 0;
  std::string name;  // the driver's
  std::int32_t minimum = 0;
  std::int32_t maximum = 0;
  std::int32_t step = 1;
  std::int32_t default_value = 0;
  std::int32_t value = 0;
  bool inactive = false;  // without effect at present, because an automatic is on
};

// The settings of a V4L2 camera that are numbers, switches or choices. Needs no stream and disturbs none: a camera may
// be open more than once, and its settings outlive whoever set them.
class CameraControls {
 public:
  // `calls` outlive it.
  explicit CameraControls(V4l2Calls& calls) : calls_(calls) {}
  ~CameraControls() { close(); }
  CameraControls(const CameraControls&) = delete;
  CameraControls& operator=(const CameraControls&) = delete;

  Status open(const std::string& device);
  void close();

  // Those that can be changed, in the driver's order.
  [[nodiscard]] std::vector<CameraControl> list();

  [[nodiscard]] std::optional<std::int32_t> value(std::uint32_t id);

  // Values out of range are refused by some drivers and cut by others. A camera that was unplugged is opened again.
  Status set(const ControlValue& wanted);

 private:
  V4l2Calls& calls_;
  std::string device_;
  int fd_ = -1;
};

}  // namespace telehug
