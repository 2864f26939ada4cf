// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "bus/bus_connection.hpp"
#include "common/clock.hpp"
#include "common/result.hpp"
#include "common/rfcomm_peer.hpp"
#include "wire/bluez_objects.hpp"
#include "wire/wire.hpp"

namespace telehug {

// Lets BlueZ look up a device's serial port and connect to it, in a thread of its own: BlueZ may take many seconds, and
// whoever asks must not wait. BlueZ ends a connection when the program that it was made for leaves the bus, so this
// lives as long as the wire.
class BluezProfile {
 public:
  struct Answer {
    bool there_is_no_bluez = false;
    Result<Wire> wire;
  };

  // `bus_address` empty: the system bus.
  BluezProfile(const RfcommPeer& peer, std::string bus_address);
  ~BluezProfile();
  BluezProfile(const BluezProfile&) = delete;
  BluezProfile& operator=(const BluezProfile&) = delete;

  // Begins, anew if it had begun before. Neither waits.
  void connect();
  [[nodiscard]] std::optional<Answer> take();

 private:
  void run();
  void wake() const;

  // The thread's own
  [[nodiscard]] Answer make_connection();
  [[nodiscard]] Answer connect_device();
  [[nodiscard]] Error refusal(const sd_bus_error& error) const;
  [[nodiscard]] BusMessage ask(const BusMessage& call, Duration patience);
  [[nodiscard]] bool process();
  void wait();
  [[nodiscard]] bool export_profile();
  int got_connection(sd_bus_message* message, sd_bus_error* error);
  static int on_connection(sd_bus_message* message, void* self, sd_bus_error* error);
  static int on_reply(sd_bus_message* message, void* self, sd_bus_error* error);

  const RfcommPeer peer_;
  const std::string bus_address_;
  Bus bus_;
  BusMessage reply_;
  std::string bluez_;   // its unique name
  std::string device_;  // its path, while its connection is waited for
  std::optional<Wire> wire_;

  const int bell_;  // an eventfd
  std::atomic<bool> wanted_ = false;
  std::atomic<bool> ending_ = false;
  std::mutex answer_mutex_;
  std::optional<Answer> answer_;
  std::thread thread_;
};

}  // namespace telehug
