// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "wire/bluez_profile.hpp"
#include "wire/rfcomm_socket.hpp"
#include "wire/wire_opener.hpp"

namespace telehug {

// A jacket by Bluetooth. With a channel by a socket of the kernel; without one through BlueZ, which looks it up, or on
// channel 1, where most have it, if there is no BlueZ.
class RfcommOpener final : public WireOpener {
 public:
  static constexpr Duration patience = 8s;  // adapters give a page up after 5 s

  // `bus_address` empty: the system bus.
  explicit RfcommOpener(const RfcommPeer& peer, RfcommSockets& sockets = kernel_rfcomm_sockets(),
                        std::string bus_address = "");
  ~RfcommOpener() override;
  RfcommOpener(const RfcommOpener&) = delete;
  RfcommOpener& operator=(const RfcommOpener&) = delete;

  [[nodiscard]] std::optional<Result<Wire>> open(Timestamp now) override;
  [[nodiscard]] const std::string& device() const override { return device_; }
  [[nodiscard]] const std::string& progress() const override { return progress_; }
  [[nodiscard]] const std::string& lost_advice() const override { return lost_advice_; }

 private:
  [[nodiscard]] std::optional<Result<Wire>> look_up(Timestamp now);
  [[nodiscard]] std::optional<Result<Wire>> connect(std::uint8_t channel, Timestamp now);
  [[nodiscard]] std::optional<Result<Wire>> go_on(Timestamp now);
  [[nodiscard]] Error fail(int error);
  [[nodiscard]] Wire hand_over();

  RfcommPeer peer_;
  RfcommSockets& sockets_;
  std::string device_;
  std::string progress_;
  std::string lost_advice_ = "switch the jacket on, or bring it nearer";

  std::unique_ptr<BluezProfile> bluez_;  // where the channel is to be looked up
  bool asked_ = false;
  int socket_ = -1;  // that is being connected
  std::uint8_t channel_ = 0;
  Timestamp give_up_at_;
};

}  // namespace telehug
