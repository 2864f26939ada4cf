// SPDX-License-Identifier: Apache-2.0
#include "ctl/own_address.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>

#include "pairing_link/tls_channel.hpp"

namespace telehug {

namespace {

// Connecting a datagram socket sends nothing; it only makes the kernel choose a route and its source address. The far
// end is of a range reserved for documentation, which only the default route leads to.
bool ask_the_kernel(in_addr& own) {
  const OwnedFd probe(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(9);
  ::inet_pton(AF_INET, "192.0.2.1", &address.sin_addr);
  auto* plain = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof(address);
  if (::connect(probe.get(), plain, size) != 0 || ::getsockname(probe.get(), plain, &size) != 0) return false;
  own = address.sin_addr;
  return true;
}

}  // namespace

Result<Endpoint> own_endpoint(const std::string& address, std::uint16_t port) {
  in_addr own{};
  if (address.empty()) {
    if (!ask_the_kernel(own))
      return Error{"this PC has no default route: give the address that the other PC can reach with --address"};
  } else if (::inet_pton(AF_INET, address.c_str(), &own) != 1) {
    return Error{"--address must be an IPv4 address of this PC, such as 192.168.1.20"};
  }
  Endpoint endpoint{.address = {}, .port = port};
  std::memcpy(endpoint.address.data(), &own, endpoint.address.size());
  return endpoint;
}

}  // namespace telehug
