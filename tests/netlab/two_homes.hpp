// SPDX-License-Identifier: Apache-2.0
//
// Two homes, each with a network of its own, and between them a middle that can be told to fail.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <queue>
#include <string>
#include <thread>
#include <vector>

#include "netlab/captured_packet.hpp"
#include "netlab/ethernet_port.hpp"
#include "netlab/faulty_way.hpp"
#include "netlab/net_namespace.hpp"

namespace telehug {

enum class Home : std::uint8_t { parent, child };

// Each home is a network namespace with a real interface ("home", a veth) and the kernel's own stack; only the middle
// is a program: a thread that carries frames between the two other ends of the veths. Nothing of it outlives this
// object.
class TwoHomes {
 public:
  // Throws std::system_error where namespaces are not permitted, std::runtime_error where `ip` fails.
  explicit TwoHomes(std::uint32_t seed);
  ~TwoHomes();
  TwoHomes(const TwoHomes&) = delete;
  TwoHomes& operator=(const TwoHomes&) = delete;

  [[nodiscard]] const NetNamespace& network(Home home) const { return side(home).network; }
  // IPv4
  [[nodiscard]] static std::string address(Home home) { return home == Home::parent ? "10.77.0.1" : "10.77.0.2"; }
  void take_address(Home home);
  void give_address(Home home);
  // Another one that a home may have.
  [[nodiscard]] static std::string other_address(Home home) {
    return home == Home::parent ? "10.77.0.11" : "10.77.0.12";
  }
  // From the first to the other one, as when a router hands out a new one; and back.
  void change_address(Home home);
  void change_address_back(Home home);
  // The interface without and with a carrier, as when its plug is pulled and put in.
  void pull_plug(Home home);
  void put_in_plug(Home home);
  // As in a VPN: what goes to more than one receiver does not pass, but for the search for neighbours.
  void stop_multicast();
  // From now on nothing passes but UDP from or to that port, and the search for neighbours.
  void let_only_pass(std::uint16_t udp_port);

  // For the packets that come from that home, from now on.
  void set(Home from, const WayFaults& faults);
  void set_both(const WayFaults& faults);

  // When the other home last got a UDP datagram of that home's programs. Replayed ones don't count.
  [[nodiscard]] std::optional<Timestamp> last_arrival(Home from) const;

  // What that home sends is kept, up to a limit, until it is taken.
  void record(Home from);
  [[nodiscard]] std::vector<CapturedPacket> take_recording(Home from);
  // Sends them to the other home again, at the pace at which they first arrived, and returns when that is done.
  void replay(Home from, const std::vector<CapturedPacket>& packets) const;
  // A datagram of some other program in that home to a port of the other home.
  void send_datagram(Home from, std::uint16_t port, const Bytes& payload) const;

 private:
  struct Side {
    Side(const NetNamespace& middle, const std::string& name, Home home, std::uint32_t seed);

    NetNamespace network;
    std::optional<EthernetPort> port;  // in the middle
    std::string middle_end;
    FaultyWay way;  // of what comes from here
    std::optional<Timestamp> last_arrival;
    bool recording = false;
    std::vector<CapturedPacket> recorded;
  };
  struct Flying {
    Timestamp arrival;
    std::uint64_t number = 0;  // of equal arrivals the earlier one first
    Home from = Home::parent;
    Bytes frame;
    bool operator<(const Flying& other) const {
      return arrival != other.arrival ? arrival > other.arrival : number > other.number;
    }
  };

  void change_address(Home home, const std::string& from, const std::string& to);
  [[nodiscard]] Side& side(Home home) { return *sides_[static_cast<std::size_t>(home)]; }
  [[nodiscard]] const Side& side(Home home) const { return *sides_[static_cast<std::size_t>(home)]; }
  [[nodiscard]] bool passes(const Bytes& frame) const;
  void carry(const std::stop_token& stop);
  void take_in(Home from);
  void let_arrive(Timestamp now);
  [[nodiscard]] Duration until_next(Timestamp now) const;

  NetNamespace middle_;
  std::array<std::optional<Side>, 2> sides_;
  mutable std::mutex mutex_;  // for the ways, the recordings and what flies
  bool multicast_passes_ = true;
  std::optional<std::uint16_t> only_port_;
  std::priority_queue<Flying> flying_;
  std::uint64_t count_ = 0;
  std::jthread carrier_;
};

}  // namespace telehug
