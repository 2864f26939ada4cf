// SPDX-License-Identifier: Apache-2.0
//
// The ways that are compared. Sender and receiver are processes of their own, in the networks they speak in.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "common/messages.hpp"

namespace telehug {

enum class Way : std::uint8_t { secured, mqtt, udp };

[[nodiscard]] constexpr const char* name_of(Way way) {
  return way == Way::secured ? "telehug" : (way == Way::mqtt ? "mqtt" : "udp");
}

// Where the two meet. Networks of their own: nobody else's ports are in the way.
struct Meeting {
  std::string address;           // the receiver's, IPv4
  bool loopback = false;         // both on one PC
  std::filesystem::path folder;  // both pair stores, and the broker's certificate
};
inline constexpr std::uint16_t udp_port = 7000;
inline constexpr std::uint16_t broker_port = 8883;
inline constexpr const char* broker_certificate = "broker.pem";
inline constexpr const char* parents_pairs = "parent";
inline constexpr const char* wearers_pairs = "wearer";

class TouchSender {
 public:
  virtual ~TouchSender() = default;
  virtual void send(const TouchEvent& event) = 0;
};

// As soon as somebody listens.
[[nodiscard]] std::unique_ptr<TouchSender> secured_sender(const Meeting& meeting);
[[nodiscard]] std::unique_ptr<TouchSender> mqtt_sender(const Meeting& meeting);
[[nodiscard]] std::unique_ptr<TouchSender> udp_sender(const Meeting& meeting);

// Called with each event that arrives and is valid.
using Receive = std::function<void(const TouchEvent&)>;

// Until the process is killed.
[[noreturn]] void receive_secured(const Meeting& meeting, const Receive& receive);
[[noreturn]] void receive_mqtt(const Meeting& meeting, const Receive& receive);
[[noreturn]] void receive_udp(const Meeting& meeting, const Receive& receive);

}  // namespace telehug
