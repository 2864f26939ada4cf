// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace telehug {

// A file descriptor as a raw wire of bytes: a terminal device, a connected socket. Nothing here waits.
class Wire {
 public:
  // Takes over a descriptor on which nothing has been written yet, and makes it non-blocking.
  explicit Wire(int fd);
  Wire(Wire&& other) noexcept;
  Wire& operator=(Wire&& other) noexcept;
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;
  ~Wire();

  // Bytes read or written, 0 if it would have to wait; nothing if the other end is gone.
  [[nodiscard]] std::optional<std::size_t> read(std::span<std::uint8_t> into);
  [[nodiscard]] std::optional<std::size_t> write(std::span<const std::uint8_t> bytes);
  // Whether the kernel holds more than a frame that the other end has not taken yet: it is slower than we talk.
  [[nodiscard]] bool has_backlog() const;

 private:
  [[nodiscard]] int queue_count() const;

  int fd_;
  bool is_socket_;
  int room_ = 0;  // of an empty queue, where the kernel counts the room in it and not the bytes
};

}  // namespace telehug
