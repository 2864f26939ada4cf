// SPDX-License-Identifier: Apache-2.0
#include "netlab/two_homes.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "netlab/run_inside.hpp"

namespace telehug {
namespace {

constexpr std::size_t most_flying = 8192;
constexpr std::size_t most_recorded = 8192;
constexpr int most_frames_at_once = 256;
// How the Ethernet addresses of IPv4 multicast begin (RFC 1112).
constexpr std::uint8_t ipv4_multicast = 0x01;

void ip(const NetNamespace& network, std::vector<std::string> words) {
  words.insert(words.begin(), "ip");
  run_inside(network, words);
}

Home other(Home home) {
  return home == Home::parent ? Home::child : Home::parent;
}

}  // namespace

TwoHomes::Side::Side(const NetNamespace& middle, const std::string& name, Home home, std::uint32_t seed)
    : middle_end(name), way(seed) {
  ip(middle, {"link", "add", middle_end, "type", "veth", "peer", "name", "home", "netns", path_of(network)});
  ip(middle, {"link", "set", middle_end, "up"});
  ip(network, {"link", "set", "lo", "up"});
  write_checksums(network, "home");
  ip(network, {"link", "set", "home", "up"});
  ip(network, {"address", "add", address(home) + "/24", "dev", "home"});
  port.emplace(middle, middle_end);
}

TwoHomes::TwoHomes(std::uint32_t seed) {
  sides_[0].emplace(middle_, "to_parent", Home::parent, seed);
  sides_[1].emplace(middle_, "to_child", Home::child, seed + 1);
  carrier_ = std::jthread([this](const std::stop_token& stop) { carry(stop); });
}

TwoHomes::~TwoHomes() = default;

void TwoHomes::take_address(Home home) {
  ip(network(home), {"address", "del", address(home) + "/24", "dev", "home"});
}

void TwoHomes::give_address(Home home) {
  ip(network(home), {"address", "add", address(home) + "/24", "dev", "home"});
}

void TwoHomes::change_address(Home home) {
  change_address(home, address(home), other_address(home));
}

void TwoHomes::change_address_back(Home home) {
  change_address(home, other_address(home), address(home));
}

void TwoHomes::change_address(Home home, const std::string& from, const std::string& to) {
  ip(network(home), {"address", "del", from + "/24", "dev", "home"});
  ip(network(home), {"address", "add", to + "/24", "dev", "home"});
}

void TwoHomes::pull_plug(Home home) {
  ip(middle_, {"link", "set", side(home).middle_end, "down"});
}

void TwoHomes::put_in_plug(Home home) {
  ip(middle_, {"link", "set", side(home).middle_end, "up"});
}

void TwoHomes::stop_multicast() {
  const std::lock_guard lock(mutex_);
  multicast_passes_ = false;
}

void TwoHomes::let_only_pass(std::uint16_t udp_port) {
  const std::lock_guard lock(mutex_);
  only_port_ = udp_port;
}

bool TwoHomes::passes(const Bytes& frame) const {
  if (!multicast_passes_ && frame[0] == ipv4_multicast) return false;
  if (!only_port_ || seeks_neighbours(frame)) return true;
  const auto datagram = udp_content(frame);
  return datagram && (datagram->port == *only_port_ || datagram->from_port == *only_port_);
}

void TwoHomes::set(Home from, const WayFaults& faults) {
  const std::lock_guard lock(mutex_);
  side(from).way.set(faults);
}

void TwoHomes::set_both(const WayFaults& faults) {
  set(Home::parent, faults);
  set(Home::child, faults);
}

std::optional<Timestamp> TwoHomes::last_arrival(Home from) const {
  const std::lock_guard lock(mutex_);
  return side(from).last_arrival;
}

void TwoHomes::record(Home from) {
  const std::lock_guard lock(mutex_);
  side(from).recording = true;
}

std::vector<CapturedPacket> TwoHomes::take_recording(Home from) {
  const std::lock_guard lock(mutex_);
  side(from).recording = false;
  return std::exchange(side(from).recorded, {});
}

void TwoHomes::replay(Home from, const std::vector<CapturedPacket>& packets) const {
  if (packets.empty()) return;
  const Duration later = SteadyClock{}.now() - packets.front().arrived;
  for (const CapturedPacket& packet : packets) {
    std::this_thread::sleep_until(packet.arrived + later);
    (void)side(other(from)).port->send(packet.frame);
  }
}

void TwoHomes::send_datagram(Home from, std::uint16_t port, const Bytes& payload) const {
  const InsideNamespace inside(network(from));
  const int datagrams = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (datagrams < 0) throw std::system_error(errno, std::generic_category(), "a socket can't be opened");
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  inet_pton(AF_INET, address(other(from)).c_str(), &to.sin_addr);
  (void)!sendto(datagrams, payload.data(), payload.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  close(datagrams);
}

void TwoHomes::carry(const std::stop_token& stop) {
  std::array<pollfd, 2> ports{pollfd{side(Home::parent).port->descriptor(), POLLIN, 0},
                              pollfd{side(Home::child).port->descriptor(), POLLIN, 0}};
  while (!stop.stop_requested()) {
    const auto wait_ns = std::chrono::nanoseconds(until_next(SteadyClock{}.now())).count();
    const timespec wait{wait_ns / 1'000'000'000, wait_ns % 1'000'000'000};
    if (ppoll(ports.data(), ports.size(), &wait, nullptr) > 0) {
      if (ports[0].revents != 0) take_in(Home::parent);
      if (ports[1].revents != 0) take_in(Home::child);
    }
    let_arrive(SteadyClock{}.now());
  }
}

// Short enough for the end of the test to be noticed soon.
Duration TwoHomes::until_next(Timestamp now) const {
  const std::lock_guard lock(mutex_);
  constexpr Duration longest = 20ms;
  return flying_.empty() ? longest : std::clamp<Duration>(flying_.top().arrival - now, 0ms, longest);
}

void TwoHomes::take_in(Home from) {
  for (int i = 0; i < most_frames_at_once; ++i) {
    Bytes frame = side(from).port->receive();
    if (frame.empty()) return;
    const std::lock_guard lock(mutex_);
    if (!passes(frame)) continue;
    for (const Timestamp arrival : side(from).way.arrivals(SteadyClock{}.now())) {
      if (flying_.size() < most_flying) flying_.push({arrival, ++count_, from, frame});
    }
  }
}

void TwoHomes::let_arrive(Timestamp now) {
  const std::lock_guard lock(mutex_);
  while (!flying_.empty() && flying_.top().arrival <= now) {
    const Flying& next = flying_.top();
    Side& sender = side(next.from);
    const bool arrived = side(other(next.from)).port->send(next.frame);
    if (arrived && udp_content(next.frame)) sender.last_arrival = now;
    if (arrived && sender.recording && sender.recorded.size() < most_recorded)
      sender.recorded.push_back({now, next.frame});
    flying_.pop();
  }
}

}  // namespace telehug
