// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bus/bus_connection.hpp"
#include "common/clock.hpp"
#include "screen_portal/portal_messages.hpp"

struct pollfd;

namespace telehug {

// What may be done after a session has failed.
enum class PortalRetry {
  soon,           // nobody decided against it
  at_users_word,  // the user said no or ended the sharing: not again without being asked to
  without_token,  // the restore token was no good: ask the user
};

struct PortalFailure {
  std::string message;  // a sentence
  PortalRetry retry = PortalRetry::soon;
};

// The picture of a monitor, where it can be got.
struct SharedScreen {
  int pipewire_fd = -1;  // a connection to PipeWire; whoever takes it closes it
  std::uint32_t node = 0;
};

// One attempt to have a monitor shared by org.freedesktop.portal.ScreenCast: connects to the bus, asks, and watches
// that the sharing goes on. It waits for nothing: process() does what can be done now. Ended with this object, also in
// the middle of the user's dialogue, which then goes away. For one thread.
class PortalSession {
 public:
  // `bus_address` empty: the session bus. `restore_token` empty: the user is asked. `clock` outlives the session.
  PortalSession(const std::string& bus_address, std::string restore_token, const Clock& clock);
  ~PortalSession();
  PortalSession(const PortalSession&) = delete;
  PortalSession& operator=(const PortalSession&) = delete;

  // Does what can be done without waiting.
  void process();

  // What to wait for before the next process(): fills `entry`, returns until when at most.
  Timestamp wait_for(pollfd& entry) const;

  // Set once, and nothing else happens after it.
  [[nodiscard]] const std::optional<PortalFailure>& failure() const { return failure_; }

  // Was the desktop asked to start, which shows its dialogue?
  [[nodiscard]] bool asked() const { return step_ >= Step::starting; }

  // Has the user agreed, now or before?
  [[nodiscard]] bool consented() const { return step_ >= Step::opening; }

  // Once, when the monitor is shared.
  std::optional<SharedScreen> take_screen();

  // When the user has agreed; empty: the portal keeps no consent.
  [[nodiscard]] const std::string& new_token() const { return new_token_; }

  // Of the portal's interface; 0 until it is known.
  [[nodiscard]] std::uint32_t version() const { return version_; }

 private:
  enum class Step { connecting, reading, creating, selecting, starting, opening, sharing };
  using Handler = void (PortalSession::*)(sd_bus_message*);

  void begin();
  void create();
  void select();
  void start();
  void got_about(sd_bus_message* reply);
  void got_request(sd_bus_message* reply);
  void got_pipewire(sd_bus_message* reply);
  void got_response(sd_bus_message* signal);
  void got_closed(sd_bus_message* signal);
  void got_owner(sd_bus_message* signal);
  void started(const PortalResponse& response);

  template <Handler handler>
  static int handle(sd_bus_message* message, void* session, sd_bus_error* error);
  void watch(BusSlot& slot, const char* match, sd_bus_message_handler_t handler);
  void call(Step step, BusMessage message, sd_bus_message_handler_t handler);
  [[nodiscard]] BusMessage new_call(const char* interface, const char* method) const;
  void append_request(sd_bus_message* message);
  void tell(const std::string& path, const char* interface) const;
  [[nodiscard]] bool is_from_portal(sd_bus_message* message) const;
  void fail(std::string message, PortalRetry retry = PortalRetry::soon);
  void fail_call(sd_bus_message* reply);

  const Clock& clock_;
  std::string token_;
  std::string new_token_;
  Step step_ = Step::connecting;
  std::optional<PortalFailure> failure_;
  std::optional<Timestamp> deadline_;  // of the step; none while the user is asked or all is well
  std::uint32_t version_ = 0;
  bool hides_cursor_ = false;
  std::string portal_;   // the unique name on the bus of who answers
  std::string request_;  // the path of the request that has not been answered; empty: none
  std::string session_;  // the path of the session; empty: none
  int requests_ = 0;
  SharedScreen screen_;
  // In this order: the slots end before the connection.
  Bus bus_;
  BusSlot responses_;
  BusSlot closings_;
  BusSlot owners_;
  BusSlot reply_;
};

}  // namespace telehug
