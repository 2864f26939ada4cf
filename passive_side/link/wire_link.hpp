// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "link/conversation.hpp"
#include "link/jacket_link.hpp"
#include "wire/wire_opener.hpp"

namespace telehug {

// A jacket at the other end of a wire, whatever that is. Opens the wire when it can and again after it was lost, with a
// growing pause in between; a jacket that falls silent is greeted again on the open wire, because closing a serial port
// would reset the microcontroller.
class WireLink final : public JacketLink {
 public:
  static constexpr Duration retry_first = 200ms;
  static constexpr Duration retry_longest = 5s;

  WireLink(std::unique_ptr<WireOpener> opener, std::unique_ptr<Conversation> conversation);

  void poll(Timestamp now) override;
  bool send(const MotorCommands& commands, Timestamp now) override;
  bool heat(const HeaterCommands& commands, Timestamp now) override;
  void stop_all(Timestamp now) override;
  [[nodiscard]] const LinkStatus& status() const override { return status_; }

 private:
  void open(Timestamp now);
  void lose(std::string problem, Timestamp now);
  void lose_wire(Timestamp now);
  void read(Timestamp now);
  void write(Timestamp now);
  void refresh_status();

  std::unique_ptr<WireOpener> opener_;
  std::unique_ptr<Conversation> conversation_;
  std::optional<Wire> wire_;
  EncodedFrame leaving_;  // the part of a frame that the wire has not taken yet
  Timestamp retry_at_;
  Duration retry_pause_ = retry_first;
  std::string problem_;  // why there is no wire
  LinkStatus status_;
};

}  // namespace telehug
