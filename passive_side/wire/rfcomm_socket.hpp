// SPDX-License-Identifier: Apache-2.0
//
// RFCOMM sockets of the kernel, without BlueZ's library, which is GPL.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "common/rfcomm_peer.hpp"

namespace telehug {

// The address as the kernel takes it (sockaddr_rc): the last pair of digits first.
struct RfcommAddress {
  std::uint16_t family = 0;
  std::array<std::uint8_t, 6> address{};
  std::uint8_t channel = 0;
};

[[nodiscard]] RfcommAddress rfcomm_address(const RfcommPeer& peer, std::uint8_t channel);

// Why it can't be connected and what to do about it, a sentence; `error`: an errno.
[[nodiscard]] std::string rfcomm_trouble(const RfcommPeer& peer, std::uint8_t channel, int error);

// The way to the kernel: the seam at which tests put a Bluetooth of their own.
class RfcommSockets {
 public:
  virtual ~RfcommSockets() = default;

  // A socket that does not block, or a negative errno.
  virtual int open() = 0;
  // 0, -EINPROGRESS (writable as soon as it is decided), or another negative errno.
  virtual int connect(int socket, const RfcommAddress& address) = 0;
};

// The kernel's.
[[nodiscard]] RfcommSockets& kernel_rfcomm_sockets();

}  // namespace telehug
