// SPDX-License-Identifier: Apache-2.0
#include "wire/rfcomm_socket.hpp"

#include <fmt/core.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace telehug {
namespace {

constexpr int rfcomm_protocol = 3;  // BTPROTO_RFCOMM

static_assert(sizeof(RfcommAddress) == 10, "the kernel refuses a shorter address");

// What the kernel makes of the reasons that Bluetooth has (net/bluetooth/lib.c).
std::string advice(const RfcommPeer& peer, std::uint8_t channel, int error) {
  std::string pair = fmt::format(
      "pair the jacket: run `bluetoothctl`, in it `scan on`, `pair {0}` (an HC-05's PIN is 1234) and `trust {0}`",
      address_text(peer));
  switch (error) {
    case EAFNOSUPPORT:
    case EPROTONOSUPPORT:
    case ESOCKTNOSUPPORT:
      return "this system's kernel has no Bluetooth; load its module rfcomm (`modprobe rfcomm`), or use a cable";
    case ENODEV:
    case ENETDOWN:
    case EHOSTUNREACH:
      return "no Bluetooth adapter is on; plug one in, and switch it on with `bluetoothctl power on`";
    case EHOSTDOWN:
    case ETIMEDOUT:
      return "the jacket is off or out of reach; switch it on and bring it nearer";
    case ECONNREFUSED:
      return fmt::format("the jacket has nothing on channel {}; leave the channel out to have it looked up", channel);
    case EACCES:
    case EPERM:
    case EBADE:
      return pair;
    case EBUSY:
      return "another program is connected with the jacket; close it";
    default:
      return "switch the jacket off and on; if that does not help, " + pair;
  }
}

class KernelRfcommSockets final : public RfcommSockets {
 public:
  int open() override {
    const int fd = socket(AF_BLUETOOTH, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, rfcomm_protocol);
    return fd < 0 ? -errno : fd;
  }
  int connect(int socket, const RfcommAddress& address) override {
    const void* const bytes = &address;
    return ::connect(socket, static_cast<const sockaddr*>(bytes), sizeof address) == 0 ? 0 : -errno;
  }
};

}  // namespace

RfcommAddress rfcomm_address(const RfcommPeer& peer, std::uint8_t channel) {
  RfcommAddress address{AF_BLUETOOTH, peer.address, channel};
  std::ranges::reverse(address.address);
  return address;
}

std::string rfcomm_trouble(const RfcommPeer& peer, std::uint8_t channel, int error) {
  return fmt::format("can't connect to {} by Bluetooth: {}: {}", address_text(peer), std::strerror(error),
                     advice(peer, channel, error));
}

RfcommSockets& kernel_rfcomm_sockets() {
  static KernelRfcommSockets sockets;
  return sockets;
}

}  // namespace telehug
