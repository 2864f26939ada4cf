// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bus/bus_connection.hpp"
#include "common/clock.hpp"

namespace telehug {

// Plain texts.
struct DesktopNotification {
  std::string title;
  std::string body;
};

// Shows notifications with a sound on the user's desktop (org.freedesktop.Notifications on the session bus). Never
// waits for the bus or the desktop. One that is shown takes the place of the one before. One thread uses a notifier.
class DesktopNotifier {
 public:
  // `bus_address` empty: the session bus. `clock` outlives the notifier.
  explicit DesktopNotifier(const Clock& clock, std::string bus_address = {});
  DesktopNotifier(const DesktopNotifier&) = delete;
  DesktopNotifier& operator=(const DesktopNotifier&) = delete;

  // On its way with the next serve(); what could not be shown within a few seconds is given up.
  void show(DesktopNotification notification);

  // Often: every 20 ms while something is to be shown.
  void serve();

  // One sentence about why the last one was not shown; empty if it was, or is on its way.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
  using Handler = void (DesktopNotifier::*)(sd_bus_message*);
  template <Handler handler>
  static int handle(sd_bus_message* message, void* notifier, sd_bus_error* error);

  void connect();
  void ask_for_capabilities();
  void got_capabilities(sd_bus_message* reply);
  void send();
  void got_id(sd_bus_message* reply);
  BusMessage new_call(const char* method);
  void call(BusMessage message, sd_bus_message_handler_t handler);
  void give_up(std::string problem);
  [[nodiscard]] static std::string refusal(sd_bus_message* reply);

  const Clock& clock_;
  const std::string bus_address_;
  std::optional<DesktopNotification> waiting_;
  Timestamp give_up_at_;  // what waits or is not answered by then
  std::string problem_;
  Bus bus_;
  BusSlot asked_;               // while an answer is awaited
  std::optional<bool> markup_;  // does the desktop read the body as markup?
  std::uint32_t shown_ = 0;     // the desktop's number of the last one
};

}  // namespace telehug
