// SPDX-License-Identifier: Apache-2.0
#include "notify/desktop_notifier.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string_view>
#include <utility>

namespace telehug {
namespace {

constexpr const char* service = "org.freedesktop.Notifications";
constexpr const char* path = "/org/freedesktop/Notifications";

constexpr Duration patience = 5s;
constexpr int as_long_as_the_desktop_likes = -1;

// Desktops that read the body as markup (capability "body-markup") would take a name's "<" for a tag's.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

bool lists(sd_bus_message* message, std::string_view wanted) {
  bool found = false;
  if (sd_bus_message_enter_container(message, SD_BUS_TYPE_ARRAY, "s") < 0) return false;
  const char* text = nullptr;
  while (sd_bus_message_read(message, "s", &text) > 0)
    found = found || text == wanted;
  return found;
}

}  // namespace

template <DesktopNotifier::Handler handler>
int DesktopNotifier::handle(sd_bus_message* message, void* notifier, sd_bus_error* /*error*/) {
  auto* self = static_cast<DesktopNotifier*>(notifier);
  self->asked_.reset();
  (self->*handler)(message);
  return 0;
}

DesktopNotifier::DesktopNotifier(const Clock& clock, std::string bus_address)
    : clock_(clock), bus_address_(std::move(bus_address)) {}

void DesktopNotifier::show(DesktopNotification notification) {
  waiting_ = std::move(notification);
  give_up_at_ = clock_.now() + patience;
  problem_.clear();
}

void DesktopNotifier::serve() {
  if (waiting_ && !bus_) connect();
  if (!bus_) return;
  int code = 0;
  while ((code = sd_bus_process(bus_.get(), nullptr)) > 0) {
  }
  const bool busy = waiting_ || asked_;
  if (code < 0) {
    give_up(busy ? fmt::format("The session bus has gone ({}); log in again if the desktop has not come back.",
                               std::strerror(-code))
                 : problem_);
    return;
  }
  const bool ready = sd_bus_is_ready(bus_.get()) > 0;
  if (waiting_ && ready && !asked_) markup_ ? send() : ask_for_capabilities();
  if (busy && clock_.now() >= give_up_at_) give_up("The desktop does not answer; log in again if that stays so.");
}

void DesktopNotifier::connect() {
  auto bus = connect_to_bus(bus_address_, "to show a notification");
  if (bus) {
    bus_ = std::move(*bus);
  } else {
    give_up(bus.error().message);
  }
}

void DesktopNotifier::ask_for_capabilities() {
  call(new_call("GetCapabilities"), handle<&DesktopNotifier::got_capabilities>);
}

void DesktopNotifier::got_capabilities(sd_bus_message* reply) {
  if (sd_bus_message_is_method_error(reply, nullptr) > 0) {
    waiting_.reset();
    problem_ = refusal(reply);
    return;
  }
  markup_ = lists(reply, "body-markup");
}

void DesktopNotifier::send() {
  const DesktopNotification notification = *std::exchange(waiting_, std::nullopt);
  const std::string body = *markup_ ? escaped(notification.body) : notification.body;
  BusMessage message = new_call("Notify");
  sd_bus_message_append(message.get(), "susss", "telehug", shown_, "emblem-favorite", notification.title.c_str(),
                        body.c_str());
  sd_bus_message_append(message.get(), "as", 0);  // nothing to click on
  sd_bus_message_append(message.get(), "a{sv}", 2, "sound-name", "s", "message-new-instant", "category", "s",
                        "im.received");
  sd_bus_message_append(message.get(), "i", as_long_as_the_desktop_likes);
  call(std::move(message), handle<&DesktopNotifier::got_id>);
}

void DesktopNotifier::got_id(sd_bus_message* reply) {
  shown_ = 0;
  if (sd_bus_message_is_method_error(reply, nullptr) > 0) {
    problem_ = refusal(reply);
    markup_.reset();  // another program may show them from now on
    return;
  }
  sd_bus_message_read(reply, "u", &shown_);
}

BusMessage DesktopNotifier::new_call(const char* method) {
  sd_bus_message* message = nullptr;
  sd_bus_message_new_method_call(bus_.get(), &message, service, path, service, method);
  return BusMessage(message);  // null only without memory: then the call fails
}

void DesktopNotifier::call(BusMessage message, sd_bus_message_handler_t handler) {
  sd_bus_slot* sent = nullptr;
  constexpr auto timeout = std::chrono::duration_cast<std::chrono::microseconds>(patience);
  const int code =
      sd_bus_call_async(bus_.get(), &sent, message.get(), handler, this, static_cast<std::uint64_t>(timeout.count()));
  asked_.reset(sent);
  if (code < 0)
    give_up(fmt::format("The desktop can't be asked to show a notification ({}); log in again.", std::strerror(-code)));
}

void DesktopNotifier::give_up(std::string problem) {
  problem_ = std::move(problem);
  waiting_.reset();
  asked_.reset();
  bus_.reset();
  markup_.reset();
  shown_ = 0;
}

std::string DesktopNotifier::refusal(sd_bus_message* reply) {
  const sd_bus_error* error = sd_bus_message_get_error(reply);
  const char* name = error != nullptr && error->name != nullptr ? error->name : "no reason given";
  return fmt::format("Nothing on this desktop shows notifications ({}); start its notification service.", name);
}

}  // namespace telehug
