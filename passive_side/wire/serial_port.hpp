// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/result.hpp"
#include "wire/serial_devices.hpp"
#include "wire/wire_opener.hpp"

namespace telehug {

inline constexpr unsigned default_baud = 57600;

// Opens a terminal device as a raw wire, for this process alone. `path` may be a link that stays the same across
// plugging (/dev/serial/by-id/...).
[[nodiscard]] Result<Wire> open_serial_port(const std::string& path, unsigned baud);

// A jacket on a serial port (USB, or a Bluetooth tty).
class SerialOpener final : public WireOpener {
 public:
  // `path`: of the device, or "auto" for the only one in `by_id`.
  SerialOpener(std::string path, unsigned baud, std::filesystem::path by_id = serial_devices_folder);

  [[nodiscard]] std::optional<Result<Wire>> open(Timestamp now) override;
  [[nodiscard]] const std::string& device() const override { return device_; }
  [[nodiscard]] const std::string& progress() const override { return device_; }
  [[nodiscard]] const std::string& lost_advice() const override { return lost_advice_; }

 private:
  [[nodiscard]] std::string better_name() const;

  bool any_;  // the only one there is
  std::string device_;
  unsigned baud_;
  std::filesystem::path by_id_;
  std::string lost_advice_ = "plug the jacket in again";
};

}  // namespace telehug
