// SPDX-License-Identifier: Apache-2.0
#include "wire/bluez_profile.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "common/printable.hpp"

namespace telehug {
namespace {

constexpr const char* profile_path = "/telehug/jacket";
constexpr Duration lookup_patience = 5s;
constexpr Duration connect_patience = 20s;  // a page, the search for the service, and the channel

std::uint64_t microseconds(Duration duration) {
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(duration).count());
}

BluezProfile::Answer no_bluez() {
  return {true, Error{"there is no BlueZ"}};
}

BluezProfile::Answer failed(std::string why) {
  return {false, Error{std::move(why)}};
}

bool has(const char* text, std::string_view part) {
  return text != nullptr && std::string_view(text).find(part) != std::string_view::npos;
}

// Method calls that need no answer but "done".
int agree(sd_bus_message* message, void* /*self*/, sd_bus_error* /*error*/) {
  return sd_bus_reply_method_return(message, nullptr);
}

}  // namespace

BluezProfile::BluezProfile(const RfcommPeer& peer, std::string bus_address)
    : peer_(peer), bus_address_(std::move(bus_address)), bell_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (bell_ < 0) throw std::runtime_error("too many files are open to look for Bluetooth devices");
}

BluezProfile::~BluezProfile() {
  ending_ = true;
  wake();
  if (thread_.joinable()) thread_.join();
  close(bell_);
}

void BluezProfile::connect() {
  wanted_ = true;
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  wake();
}

std::optional<BluezProfile::Answer> BluezProfile::take() {
  const std::unique_lock lock(answer_mutex_, std::try_to_lock);
  return lock.owns_lock() ? std::exchange(answer_, std::nullopt) : std::nullopt;
}

void BluezProfile::wake() const {
  eventfd_write(bell_, 1);
}

void BluezProfile::run() {
  while (!ending_) {
    if (wanted_.exchange(false)) {
      Answer answer = make_connection();
      const std::lock_guard lock(answer_mutex_);
      answer_.emplace(std::move(answer));
    } else if (process()) {
      wait();
    }
  }
  bus_.reset();
}

// On a bus connection of its own: BlueZ may have been started again, and forgets an old one's profile by itself.
BluezProfile::Answer BluezProfile::make_connection() {
  bus_.reset();
  auto bus = connect_to_system_bus(bus_address_);
  if (!bus) return no_bluez();
  bus_ = *std::move(bus);
  if (!export_profile()) return no_bluez();
  sd_bus_message* made = nullptr;
  sd_bus_message_new_method_call(bus_.get(), &made, bluez_service, "/org/bluez", "org.bluez.ProfileManager1",
                                 "RegisterProfile");
  BusMessage registering(made);
  sd_bus_message_append(made, "osa{sv}", profile_path, serial_port_uuid, 1, "Role", "s", "client");
  const BusMessage registered = ask(registering, lookup_patience);
  if (!registered) return no_bluez();  // nor a bus
  if (const sd_bus_error* error = sd_bus_message_get_error(registered.get())) {
    return means_no_bluez(*error) ? no_bluez() : Answer{false, refusal(*error)};
  }
  bluez_ = sd_bus_message_get_sender(registered.get());
  Answer answer = connect_device();
  device_.clear();
  wire_.reset();
  return answer;
}

BluezProfile::Answer BluezProfile::connect_device() {
  const BusMessage told = ask(bluez_objects_call(bus_.get()), lookup_patience);
  const auto objects = told ? read_bluez_objects(told.get()) : std::nullopt;
  if (!objects)
    return failed("BlueZ does not tell which devices it knows; start it again: `systemctl restart bluetooth`");
  if (std::string trouble = bluez_trouble(*objects, peer_); !trouble.empty()) return failed(std::move(trouble));

  device_ = objects->find(peer_)->path;
  sd_bus_message* made = nullptr;
  sd_bus_message_new_method_call(bus_.get(), &made, bluez_service, device_.c_str(), "org.bluez.Device1",
                                 "ConnectProfile");
  BusMessage connecting(made);
  sd_bus_message_append(made, "s", serial_port_uuid);
  const BusMessage connected = ask(connecting, connect_patience);
  if (!connected) return failed("the system bus has gone");
  if (const sd_bus_error* error = sd_bus_message_get_error(connected.get())) return {false, refusal(*error)};
  if (!wire_) return failed("BlueZ has connected to the jacket but handed no connection over; start BlueZ again");
  return {false, *std::exchange(wire_, std::nullopt)};
}

Error BluezProfile::refusal(const sd_bus_error& error) const {
  std::string_view advice = "switch the jacket off and on";
  if (has(error.message, "page-timeout") || has(error.message, "Host is down") || has(error.name, "NoReply")) {
    advice = "the jacket is off or out of reach; switch it on and bring it nearer";
  } else if (has(error.message, "key-missing") || has(error.name, "Authentication") ||
             has(error.message, "refused-by-security")) {
    advice = "pair it again: in `bluetoothctl`, `remove` its address, `scan on`, `pair` and `trust` it";
  } else if (has(error.name, "NotAvailable") || has(error.name, "DoesNotExist") ||
             has(error.message, "profile-unavail")) {
    advice = "it offers no serial port; check the address";
  } else if (has(error.name, "AlreadyConnected") || has(error.name, "InProgress")) {
    advice = "another program is connected with it; close that";
  } else if (has(error.name, "AccessDenied")) {
    advice = "add this user to the group bluetooth";
  }
  const char* const said = error.message == nullptr ? error.name : error.message;
  return Error{fmt::format("can't connect to {} by Bluetooth: {}: {}", address_text(peer_),
                           printable(said) ? said : "BlueZ says what can't be shown", advice)};
}

// Serves the bus until the answer comes; none if the bus goes or this ends.
BusMessage BluezProfile::ask(const BusMessage& call, Duration patience) {
  reply_.reset();
  sd_bus_slot* made = nullptr;
  if (sd_bus_call_async(bus_.get(), &made, call.get(), on_reply, this, microseconds(patience)) < 0) return nullptr;
  const BusSlot slot(made);
  while (!reply_ && !ending_ && process()) {
    if (!reply_) wait();
  }
  return std::move(reply_);
}

int BluezProfile::on_reply(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
  static_cast<BluezProfile*>(self)->reply_.reset(sd_bus_message_ref(message));
  return 0;
}

// False if that took the bus.
bool BluezProfile::process() {
  int code = 0;
  while (bus_ && (code = sd_bus_process(bus_.get(), nullptr)) > 0) {
  }
  if (code < 0) bus_.reset();
  return code >= 0;
}

// Until there is something to do, for the bus or at our own bell.
void BluezProfile::wait() {
  std::array<pollfd, 2> waited{{{bell_, POLLIN, 0}, {-1, 0, 0}}};
  std::uint64_t until_us = UINT64_MAX;
  if (bus_) {
    waited[1] = {sd_bus_get_fd(bus_.get()), static_cast<short>(sd_bus_get_events(bus_.get())), 0};
    sd_bus_get_timeout(bus_.get(), &until_us);
  }
  int longest_ms = -1;
  if (until_us != UINT64_MAX) {
    const auto now_us = microseconds(SteadyClock{}.now().time_since_epoch());
    longest_ms = until_us <= now_us ? 0 : static_cast<int>((until_us - now_us) / 1000 + 1);
  }
  poll(waited.data(), waited.size(), longest_ms);
  eventfd_t rung = 0;
  eventfd_read(bell_, &rung);
}

bool BluezProfile::export_profile() {
  // Not for root alone: BlueZ runs without the rights that sd-bus would ask for. Who calls is checked.
  static const sd_bus_vtable methods[] = {
      SD_BUS_VTABLE_START(0), SD_BUS_METHOD("NewConnection", "oha{sv}", "", on_connection, SD_BUS_VTABLE_UNPRIVILEGED),
      SD_BUS_METHOD("RequestDisconnection", "o", "", agree, SD_BUS_VTABLE_UNPRIVILEGED),
      SD_BUS_METHOD("Release", "", "", agree, SD_BUS_VTABLE_UNPRIVILEGED), SD_BUS_VTABLE_END};
  return sd_bus_add_object_vtable(bus_.get(), nullptr, profile_path, "org.bluez.Profile1", methods, this) >= 0;
}

int BluezProfile::on_connection(sd_bus_message* message, void* self, sd_bus_error* error) {
  return static_cast<BluezProfile*>(self)->got_connection(message, error);
}

int BluezProfile::got_connection(sd_bus_message* message, sd_bus_error* error) {
  const char* device = nullptr;
  int fd = -1;  // the message's own
  if (sd_bus_message_read(message, "oh", &device, &fd) < 0) return -EINVAL;
  const char* sender = sd_bus_message_get_sender(message);
  if (sender == nullptr || bluez_ != sender || device_ != device) {
    return sd_bus_error_set(error, "org.bluez.Error.Rejected", "nobody has asked for this connection");
  }
  wire_.emplace(fcntl(fd, F_DUPFD_CLOEXEC, 0));
  return sd_bus_reply_method_return(message, nullptr);
}

}  // namespace telehug
