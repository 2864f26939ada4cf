// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/portal_session.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "screen_portal/portal_errors.hpp"

namespace telehug {
namespace {

constexpr const char* portal_name = "org.freedesktop.portal.Desktop";
constexpr const char* portal_path = "/org/freedesktop/portal/desktop";
constexpr const char* screen_cast = "org.freedesktop.portal.ScreenCast";

constexpr std::uint32_t hidden_cursor = 1;
constexpr std::uint32_t until_revoked = 2;
constexpr std::uint32_t first_version_with_cursor_modes = 2;
constexpr std::uint32_t first_version_with_tokens = 4;

// For the steps in which no user is asked. The bus starts the portal if it does not run yet.
constexpr Duration longest_answer = 30s;

constexpr std::uint32_t request_done = 0;
constexpr std::uint32_t request_refused = 1;

}  // namespace

template <PortalSession::Handler handler>
int PortalSession::handle(sd_bus_message* message, void* session, sd_bus_error* /*error*/) {
  auto* self = static_cast<PortalSession*>(session);
  if (!self->failure_) (self->*handler)(message);
  return 0;
}

PortalSession::PortalSession(const std::string& bus_address, std::string restore_token, const Clock& clock)
    : clock_(clock), token_(std::move(restore_token)), deadline_(clock.now() + longest_answer) {
  auto bus = connect_to_bus(bus_address, "to ask the desktop for its screen");
  if (bus) {
    bus_ = std::move(*bus);
  } else {
    fail(bus.error().message);
  }
}

PortalSession::~PortalSession() {
  if (screen_.pipewire_fd >= 0) ::close(screen_.pipewire_fd);
  if (!request_.empty()) tell(request_, "org.freedesktop.portal.Request");
  if (!session_.empty()) tell(session_, "org.freedesktop.portal.Session");
}

void PortalSession::process() {
  int code = 0;
  while (!failure_ && (code = sd_bus_process(bus_.get(), nullptr)) > 0) {
  }
  if (failure_) return;
  if (code < 0) {
    fail(fmt::format("The session bus has gone ({}); log in again if the desktop has not come back.",
                     std::strerror(-code)));
  } else if (step_ == Step::connecting && sd_bus_is_ready(bus_.get()) > 0) {
    begin();
  } else if (deadline_ && clock_.now() >= *deadline_) {
    fail("The desktop's portal does not answer; log in again if that stays so.");
  }
}

Timestamp PortalSession::wait_for(pollfd& entry) const {
  entry.fd = -1;
  if (failure_) return Timestamp::max();
  entry.fd = sd_bus_get_fd(bus_.get());
  entry.events = static_cast<short>(std::max(0, sd_bus_get_events(bus_.get())));
  Timestamp until = deadline_.value_or(Timestamp::max());
  std::uint64_t timeout_us = 0;  // on CLOCK_MONOTONIC; all ones: none
  if (sd_bus_get_timeout(bus_.get(), &timeout_us) > 0)
    until = std::min(until, Timestamp(std::chrono::microseconds(timeout_us)));
  return until;
}

std::optional<SharedScreen> PortalSession::take_screen() {
  if (screen_.pipewire_fd < 0) return std::nullopt;
  return std::exchange(screen_, SharedScreen{});
}

void PortalSession::begin() {
  watch(responses_, "type='signal',interface='org.freedesktop.portal.Request',member='Response'",
        handle<&PortalSession::got_response>);
  watch(closings_, "type='signal',interface='org.freedesktop.portal.Session',member='Closed'",
        handle<&PortalSession::got_closed>);
  watch(owners_,
        "type='signal',sender='org.freedesktop.DBus',interface='org.freedesktop.DBus',member='NameOwnerChanged',"
        "arg0='org.freedesktop.portal.Desktop'",
        handle<&PortalSession::got_owner>);
  BusMessage message = new_call("org.freedesktop.DBus.Properties", "GetAll");
  sd_bus_message_append(message.get(), "s", screen_cast);
  call(Step::reading, std::move(message), handle<&PortalSession::got_about>);
}

void PortalSession::got_about(sd_bus_message* reply) {
  if (sd_bus_message_is_method_error(reply, nullptr) > 0) return fail_call(reply);
  const auto about = read_portal_about(reply);
  const char* sender = sd_bus_message_get_sender(reply);
  if (!about || sender == nullptr) return fail("The desktop's portal does not say what it can do; update it.");
  if ((about->source_types & portal_monitors) == 0) return fail(portal_without_monitors().message);
  portal_ = sender;
  version_ = about->version;
  hides_cursor_ = version_ >= first_version_with_cursor_modes && (about->cursor_modes & hidden_cursor) != 0;
  if (version_ < first_version_with_tokens) token_.clear();
  create();
}

void PortalSession::create() {
  BusMessage message = new_call(screen_cast, "CreateSession");
  sd_bus_message_open_container(message.get(), SD_BUS_TYPE_ARRAY, "{sv}");
  append_request(message.get());
  sd_bus_message_append(message.get(), "{sv}", "session_handle_token", "s", "telehug");
  sd_bus_message_close_container(message.get());
  call(Step::creating, std::move(message), handle<&PortalSession::got_request>);
}

void PortalSession::select() {
  BusMessage message = new_call(screen_cast, "SelectSources");
  sd_bus_message_append(message.get(), "o", session_.c_str());
  sd_bus_message_open_container(message.get(), SD_BUS_TYPE_ARRAY, "{sv}");
  append_request(message.get());
  // Only monitors: where a window lies on the screen is not known under Wayland.
  sd_bus_message_append(message.get(), "{sv}", "types", "u", portal_monitors);
  sd_bus_message_append(message.get(), "{sv}", "multiple", "b", 0);
  if (hides_cursor_) sd_bus_message_append(message.get(), "{sv}", "cursor_mode", "u", hidden_cursor);
  if (version_ >= first_version_with_tokens) {
    sd_bus_message_append(message.get(), "{sv}", "persist_mode", "u", until_revoked);
    if (!token_.empty()) sd_bus_message_append(message.get(), "{sv}", "restore_token", "s", token_.c_str());
  }
  sd_bus_message_close_container(message.get());
  call(Step::selecting, std::move(message), handle<&PortalSession::got_request>);
}

void PortalSession::start() {
  BusMessage message = new_call(screen_cast, "Start");
  sd_bus_message_append(message.get(), "os", session_.c_str(), "");
  sd_bus_message_open_container(message.get(), SD_BUS_TYPE_ARRAY, "{sv}");
  append_request(message.get());
  sd_bus_message_close_container(message.get());
  call(Step::starting, std::move(message), handle<&PortalSession::got_request>);
}

void PortalSession::got_request(sd_bus_message* reply) {
  if (sd_bus_message_is_method_error(reply, nullptr) > 0) return fail_call(reply);
  const char* path = nullptr;
  if (sd_bus_message_read_basic(reply, SD_BUS_TYPE_OBJECT_PATH, static_cast<void*>(&path)) <= 0) {
    return fail("The desktop's portal answers with what is no request; update it.");
  }
  request_ = path;  // portals before version 0.9 choose it themselves
}

void PortalSession::got_response(sd_bus_message* signal) {
  const char* path = sd_bus_message_get_path(signal);
  if (!is_from_portal(signal) || request_.empty() || path == nullptr || request_ != path) return;
  request_.clear();
  reply_.reset();
  const auto response = read_portal_response(signal);
  if (!response) return fail("The desktop's portal answers what can't be read; update it.");
  if (step_ == Step::starting) return started(*response);
  if (response->code != request_done) {
    return fail("The desktop's portal does not let telehug ask for the screen; log in again or update the portal.",
                token_.empty() ? PortalRetry::soon : PortalRetry::without_token);
  }
  if (step_ == Step::selecting) return start();
  if (sd_bus_object_path_is_valid(response->session.c_str()) <= 0) {
    return fail("The desktop's portal opens a session without a name; update it.");
  }
  session_ = response->session;
  select();
}

void PortalSession::started(const PortalResponse& response) {
  if (response.code == request_refused) {
    return fail("Sharing the screen was refused in the desktop's dialogue.", PortalRetry::at_users_word);
  }
  if (response.code != request_done) {
    return fail("The desktop's dialogue was ended before the screen was shared.",
                token_.empty() ? PortalRetry::at_users_word : PortalRetry::without_token);
  }
  if (const auto wrong = fault_of_streams(response.streams)) return fail(wrong->message, PortalRetry::at_users_word);
  screen_.node = response.streams[0].node;
  if (version_ >= first_version_with_tokens) new_token_ = response.restore_token;
  BusMessage message = new_call(screen_cast, "OpenPipeWireRemote");
  sd_bus_message_append(message.get(), "oa{sv}", session_.c_str(), 0);
  call(Step::opening, std::move(message), handle<&PortalSession::got_pipewire>);
}

void PortalSession::got_pipewire(sd_bus_message* reply) {
  const char* error = sd_bus_message_is_method_error(reply, nullptr) > 0 ? sd_bus_message_get_error(reply)->name : "";
  int fd = -1;  // the message's own
  if (error[0] == '\0') sd_bus_message_read_basic(reply, SD_BUS_TYPE_UNIX_FD, &fd);
  screen_.pipewire_fd = fd < 0 ? -1 : ::fcntl(fd, F_DUPFD_CLOEXEC, 3);
  if (screen_.pipewire_fd < 0) {
    return fail(
        fmt::format("The desktop's portal can't reach PipeWire{}; is it running (systemctl --user status "
                    "pipewire)?",
                    error[0] == '\0' ? "" : fmt::format(" ({})", error)));
  }
  step_ = Step::sharing;
  deadline_.reset();
}

void PortalSession::got_closed(sd_bus_message* signal) {
  const char* path = sd_bus_message_get_path(signal);
  if (!is_from_portal(signal) || session_.empty() || path == nullptr || session_ != path) return;
  session_.clear();
  fail("Sharing the screen was ended at the desktop.", PortalRetry::at_users_word);
}

void PortalSession::got_owner(sd_bus_message* signal) {
  const char* name = nullptr;
  const char* before = nullptr;
  if (sd_bus_message_read(signal, "ss", &name, &before) <= 0 || portal_.empty() || portal_ != before) return;
  session_.clear();
  request_.clear();
  fail("The desktop's portal has ended, and with it the sharing of the screen; log in again if it does not come back.");
}

void PortalSession::watch(BusSlot& slot, const char* match, sd_bus_message_handler_t handler) {
  sd_bus_slot* added = nullptr;
  const int code = sd_bus_add_match_async(bus_.get(), &added, match, handler, nullptr, this);
  slot.reset(added);
  if (code < 0) fail(fmt::format("The session bus can't be listened to ({}); log in again.", std::strerror(-code)));
}

void PortalSession::call(Step step, BusMessage message, sd_bus_message_handler_t handler) {
  if (failure_) return;
  step_ = step;
  deadline_ = clock_.now() + longest_answer;
  if (step == Step::starting) deadline_.reset();  // a person answers
  sd_bus_slot* sent = nullptr;
  constexpr auto timeout = std::chrono::duration_cast<std::chrono::microseconds>(longest_answer);
  const int code =
      sd_bus_call_async(bus_.get(), &sent, message.get(), handler, this, static_cast<std::uint64_t>(timeout.count()));
  reply_.reset(sent);
  if (code < 0) {
    fail(fmt::format("The desktop's portal can't be asked for the screen ({}); log in again.", std::strerror(-code)));
  }
}

BusMessage PortalSession::new_call(const char* interface, const char* method) const {
  sd_bus_message* message = nullptr;
  sd_bus_message_new_method_call(bus_.get(), &message, portal_name, portal_path, interface, method);
  return BusMessage(message);  // null only without memory: then the call fails
}

// The path of a request is agreed on before it is made, so that no answer is missed.
void PortalSession::append_request(sd_bus_message* message) {
  const char* name = "";
  sd_bus_get_unique_name(bus_.get(), &name);
  std::string sender = name[0] == ':' ? name + 1 : name;
  std::replace(sender.begin(), sender.end(), '.', '_');
  const std::string token = fmt::format("telehug{}", ++requests_);
  request_ = fmt::format("{}/request/{}/{}", portal_path, sender, token);
  sd_bus_message_append(message, "{sv}", "handle_token", "s", token.c_str());
}

// Ends the object at `path`. Nobody waits for an answer.
void PortalSession::tell(const std::string& path, const char* interface) const {
  sd_bus_message* made = nullptr;
  if (sd_bus_message_new_method_call(bus_.get(), &made, portal_name, path.c_str(), interface, "Close") < 0) return;
  const BusMessage message(made);
  sd_bus_message_set_expect_reply(made, 0);
  sd_bus_send(bus_.get(), made, nullptr);
}

bool PortalSession::is_from_portal(sd_bus_message* message) const {
  const char* sender = sd_bus_message_get_sender(message);
  return sender != nullptr && !portal_.empty() && portal_ == sender;
}

void PortalSession::fail(std::string message, PortalRetry retry) {
  failure_ = PortalFailure{std::move(message), retry};
}

void PortalSession::fail_call(sd_bus_message* reply) {
  request_.clear();
  const bool may_be_the_token = step_ > Step::reading && !token_.empty();
  fail(portal_call_failure(sd_bus_message_get_error(reply)->name, step_ == Step::reading).message,
       may_be_the_token ? PortalRetry::without_token : PortalRetry::soon);
}

}  // namespace telehug
