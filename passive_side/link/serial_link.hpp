// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "link/jacket_link.hpp"
#include "link/jacket_session.hpp"
#include "link/serial_port.hpp"

namespace telehug {

inline constexpr unsigned default_baud = 57600;

// A jacket on a serial port (USB, or a Bluetooth tty). Opens the port when it appears and again after it was lost, with
// a growing pause in between; a jacket that falls silent is greeted again on the open port, because closing it would
// reset the microcontroller.
class SerialLink final : public JacketLink {
 public:
  static constexpr Duration retry_first = 200ms;
  static constexpr Duration retry_longest = 5s;

  explicit SerialLink(std::string path, unsigned baud = default_baud);

  void poll(Timestamp now) override;
  bool send(const MotorCommands& commands, Timestamp now) override;
  bool heat(const HeaterCommands& commands, Timestamp now) override;
  void stop_all(Timestamp now) override;
  [[nodiscard]] const LinkStatus& status() const override { return status_; }

 private:
  void open(Timestamp now);
  void lose(std::string problem, Timestamp now);
  void read(Timestamp now);
  void write(Timestamp now);
  void refresh_status();

  std::string path_;
  unsigned baud_;
  std::optional<SerialPort> port_;
  JacketSession session_;
  EncodedFrame leaving_;  // the part of a frame that the port has not taken yet
  Timestamp retry_at_;
  Duration retry_pause_ = retry_first;
  LinkStatus status_;
};

}  // namespace telehug
