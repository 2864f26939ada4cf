// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "common/result.hpp"

namespace telehug {

// A terminal device as a raw wire of bytes, owned by this process alone. Nothing here waits.
class SerialPort {
 public:
  // `path` may be a link that stays the same across plugging (/dev/serial/by-id/...).
  [[nodiscard]] static Result<SerialPort> open(const std::string& path, unsigned baud);

  SerialPort(SerialPort&& other) noexcept;
  SerialPort& operator=(SerialPort&& other) noexcept;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort();

  // Bytes read or written, 0 if it would have to wait; nothing if the device is gone.
  [[nodiscard]] std::optional<std::size_t> read(std::span<std::uint8_t> into);
  [[nodiscard]] std::optional<std::size_t> write(std::span<const std::uint8_t> bytes);
  // Bytes that the kernel holds and the wire has not taken yet.
  [[nodiscard]] std::size_t unsent() const;

 private:
  explicit SerialPort(int fd) : fd_(fd) {}
  int fd_;
};

}  // namespace telehug
