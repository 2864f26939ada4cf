// SPDX-License-Identifier: Apache-2.0
#include "netlab/ethernet_port.hpp"

#include <linux/ethtool.h>
#include <linux/if_packet.h>
#include <linux/sockios.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace telehug {
namespace {

void require(bool done, const char* what) {
  if (!done) throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

EthernetPort::EthernetPort(const NetNamespace& network, const std::string& interface) {
  const InsideNamespace inside(network);
  descriptor_ = socket(AF_PACKET, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, htons(ETH_P_ALL));
  require(descriptor_ >= 0, "a raw socket can't be opened");
  const int on = 1;
  // Otherwise it would forward its own frames back.
  require(setsockopt(descriptor_, SOL_PACKET, PACKET_IGNORE_OUTGOING, &on, sizeof on) == 0, "PACKET_IGNORE_OUTGOING");
  sockaddr_ll address{};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(ETH_P_ALL);
  address.sll_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
  require(address.sll_ifindex != 0, "the interface is missing");
  sockaddr_storage any{};
  *reinterpret_cast<sockaddr_ll*>(&any) = address;
  require(bind(descriptor_, reinterpret_cast<const sockaddr*>(&any), sizeof address) == 0, "bind");
}

EthernetPort::~EthernetPort() {
  close(descriptor_);
}

Bytes EthernetPort::receive() const {
  std::array<std::uint8_t, 65536> buffer{};
  const ssize_t size = recv(descriptor_, buffer.data(), buffer.size(), 0);
  if (size <= 0) return {};
  return {buffer.begin(), buffer.begin() + size};
}

bool EthernetPort::send(const Bytes& frame) const {
  return ::send(descriptor_, frame.data(), frame.size(), 0) >= 0;
}

void write_checksums(const NetNamespace& network, const std::string& interface) {
  const InsideNamespace inside(network);
  const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  require(any >= 0, "a socket can't be opened");
  ethtool_value off{ETHTOOL_STXCSUM, 0};
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  request.ifr_data = reinterpret_cast<char*>(&off);
  const bool done = ioctl(any, SIOCETHTOOL, &request) == 0;
  close(any);
  require(done, "the checksums of a veth can't be turned on");
}

}  // namespace telehug
