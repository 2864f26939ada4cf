// SPDX-License-Identifier: Apache-2.0
#include "network/address_watcher.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>

namespace telehug {
namespace {

std::optional<std::set<std::string>> present_addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, &freeifaddrs);
  std::set<std::string> addresses;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    constexpr unsigned usable = IFF_UP | IFF_RUNNING;
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    if ((entry->ifa_flags & usable) != usable || (entry->ifa_flags & IFF_LOOPBACK) != 0) continue;
    sockaddr_in address{};
    std::memcpy(&address, entry->ifa_addr, sizeof address);
    std::array<char, INET_ADDRSTRLEN> text{};
    inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
    addresses.insert(std::string(entry->ifa_name) + " " + text.data());
  }
  return addresses;
}

}  // namespace

AddressWatcher::AddressWatcher() {
  fd_ = socket(AF_NETLINK, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, NETLINK_ROUTE);
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "can't watch this PC's network addresses");
  sockaddr_nl groups{};
  groups.nl_family = AF_NETLINK;
  groups.nl_groups = RTMGRP_LINK | RTMGRP_IPV4_IFADDR;
  sockaddr address{};
  static_assert(sizeof groups <= sizeof address);
  std::memcpy(&address, &groups, sizeof groups);
  if (bind(fd_, &address, sizeof groups) != 0) {
    const int problem = errno;
    close(fd_);
    throw std::system_error(problem, std::generic_category(), "can't watch this PC's network addresses");
  }
  // After the watch began, so that no change falls between the two.
  if (auto present = present_addresses()) {
    addresses_ = std::move(*present);
  } else {
    look_again_ = true;
  }
}

AddressWatcher::~AddressWatcher() {
  close(fd_);
}

bool AddressWatcher::changed() {
  if (!heard_anything() && !look_again_) return false;
  auto present = present_addresses();
  look_again_ = !present;
  if (!present || *present == addresses_) return false;
  addresses_ = std::move(*present);
  return true;
}

bool AddressWatcher::heard_anything() const noexcept {
  bool anything = false;
  std::array<char, 8192> words{};
  for (;;) {
    const ssize_t size = recv(fd_, words.data(), words.size(), 0);
    if (size < 0 && errno == EINTR) continue;
    if (size > 0 || (size < 0 && errno == ENOBUFS)) {  // ENOBUFS: some were dropped
      anything = true;
      continue;
    }
    return anything;
  }
}

}  // namespace telehug
