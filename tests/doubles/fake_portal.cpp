// SPDX-License-Identifier: Apache-2.0
#include "doubles/fake_portal.hpp"

#include <algorithm>
#include <chrono>

namespace telehug {
namespace {

constexpr const char* portal_name = "org.freedesktop.portal.Desktop";
constexpr const char* desktop = "/org/freedesktop/portal/desktop";
constexpr const char* screen_cast = "org.freedesktop.portal.ScreenCast";
constexpr const char* request_interface = "org.freedesktop.portal.Request";
constexpr const char* session_interface = "org.freedesktop.portal.Session";

void answer_with(sdbus::Signal& signal, std::uint32_t code, const PortalWords& words) {
  signal << code << words;
}

std::string text(const PortalWords& options, const char* key) {
  const auto found = options.find(key);
  return found == options.end() ? "" : found->second.get<std::string>();
}

}  // namespace

FakePortal::FakePortal(const std::string& bus_address, Script script)
    : script_(std::move(script)), connection_(sdbus::createSessionBusConnectionWithAddress(bus_address)) {
  desktop_ = sdbus::createObject(*connection_, desktop);
  if (script_.can_share_screens) export_screen_cast();
  desktop_->finishRegistration();
  connection_->requestName(portal_name);
  connection_->enterEventLoopAsync();
}

FakePortal::~FakePortal() {
  connection_->leaveEventLoop();
  connection_->releaseName(portal_name);  // waits for it: the next one shall get it
}

void FakePortal::export_screen_cast() {
  desktop_->registerProperty("version").onInterface(screen_cast).withGetter([this] { return script().version; });
  desktop_->registerProperty("AvailableSourceTypes").onInterface(screen_cast).withGetter([this] {
    return script().source_types;
  });
  desktop_->registerProperty("AvailableCursorModes").onInterface(screen_cast).withGetter([this] {
    return script().cursor_modes;
  });
  desktop_->registerMethod("CreateSession")
      .onInterface(screen_cast)
      .implementedAs([this](Reply&& reply, const PortalWords& options) { create(std::move(reply), options); });
  desktop_->registerMethod("SelectSources")
      .onInterface(screen_cast)
      .implementedAs([this](Reply&& reply, const sdbus::ObjectPath&, const PortalWords& options) {
        select(std::move(reply), options);
      });
  desktop_->registerMethod("Start")
      .onInterface(screen_cast)
      .implementedAs([this](Reply&& reply, const sdbus::ObjectPath&, const std::string&, const PortalWords& options) {
        start(std::move(reply), options);
      });
  desktop_->registerMethod("OpenPipeWireRemote")
      .onInterface(screen_cast)
      .implementedAs([this](const sdbus::ObjectPath&, const PortalWords&) {
        const Script now = script();
        const int fd = now.connect_to_pipewire ? now.connect_to_pipewire() : -1;
        if (fd < 0) throw sdbus::Error("org.freedesktop.portal.Error.Failed", "no PipeWire");
        return sdbus::UnixFd(fd, sdbus::adopt_fd);
      });
}

void FakePortal::create(Reply&& reply, const PortalWords& options) {
  const std::string request = add_request(options);
  const std::string session = path_for("session", options, "session_handle_token");
  add_closable(session, session_interface);
  {
    const std::lock_guard lock(mutex_);
    session_ = session;
  }
  reply.returnResults(request);
  const Answer other = script().answer_create;
  respond(
      request, other ? other : [&](sdbus::Signal& signal) {
        answer_with(signal, 0, {{"session_handle", sdbus::Variant(session)}});
      });
}

void FakePortal::select(Reply&& reply, const PortalWords& options) {
  note([&](Seen& seen) { seen.select = options; });
  const Script now = script();
  const std::string token = text(options, "restore_token");
  if (!token.empty() && now.good_token.value_or(token) != token && now.bad_token_is_an_error) {
    return reply.returnError(sdbus::Error("org.freedesktop.portal.Error.InvalidArgument", "no such token"));
  }
  const std::string request = add_request(options);
  reply.returnResults(request);
  respond(
      request, now.answer_select ? now.answer_select : [](sdbus::Signal& signal) { answer_with(signal, 0, {}); });
}

void FakePortal::start(Reply&& reply, const PortalWords& options) {
  const std::string request = add_request(options);
  reply.returnResults(request);
  const bool waits = script().user_hesitates;
  if (waits) {
    const std::lock_guard lock(mutex_);
    waiting_ = request;
  }
  note([](Seen& seen) { ++seen.starts; });
  if (!waits) respond(request, start_answer());
}

FakePortal::Answer FakePortal::start_answer() const {
  const Script now = script();
  if (now.answer_start) return now.answer_start;
  const std::string token = text(seen().select, "restore_token");
  const bool bad_token = !token.empty() && now.good_token.value_or(token) != token;
  return [now, bad_token](sdbus::Signal& signal) {
    if (bad_token || now.user_says != 0) return answer_with(signal, bad_token ? 2 : now.user_says, {});
    PortalWords about_stream{{"size", sdbus::Variant(sdbus::make_struct(32, 24))},
                             {"position", sdbus::Variant(sdbus::make_struct(0, 0))}};
    if (now.version >= 3) about_stream["source_type"] = sdbus::Variant(std::uint32_t{1});
    PortalWords words{{"streams", sdbus::Variant(PortalNodes{{now.node, about_stream}})}};
    if (now.version >= 4 && !now.token.empty()) {
      words["persist_mode"] = sdbus::Variant(std::uint32_t{2});
      words["restore_token"] = sdbus::Variant(now.token);
    }
    answer_with(signal, 0, words);
  };
}

void FakePortal::answer() {
  std::string request;
  {
    const std::lock_guard lock(mutex_);
    std::swap(request, waiting_);
  }
  respond(request, start_answer());
}

void FakePortal::end_session() {
  std::unique_lock lock(mutex_);
  sdbus::IObject& session = *by_path_.at(session_);
  lock.unlock();
  sdbus::Signal signal = session.createSignal(session_interface, "Closed");
  signal << PortalWords{};
  session.emitSignal(signal);
}

// PATH/KIND/SENDER/TOKEN
std::string FakePortal::path_for(const char* kind, const PortalWords& options, const char* key) const {
  std::string sender = desktop_->getCurrentlyProcessedMessage()->getSender().substr(1);
  std::replace(sender.begin(), sender.end(), '.', '_');
  return std::string(desktop) + '/' + kind + '/' + sender + '/' + text(options, key);
}

std::string FakePortal::add_request(const PortalWords& options) {
  std::string path = path_for("request", options, "handle_token");
  if (script().chooses_paths) path += "_of_its_own";
  add_closable(path, request_interface);
  return path;
}

void FakePortal::add_closable(const std::string& path, const char* interface) {
  auto object = sdbus::createObject(*connection_, path);
  const auto close = [this, path] { note([&](Seen& seen) { seen.closed.push_back(path); }); };
  object->registerMethod("Close").onInterface(interface).implementedAs(close);
  object->finishRegistration();  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): the object owns the handler
  const std::lock_guard lock(mutex_);
  by_path_[path] = object.get();
  objects_.push_back(std::move(object));
}

void FakePortal::respond(const std::string& request, const Answer& answer) {
  std::unique_lock lock(mutex_);
  sdbus::IObject& object = *by_path_.at(request);
  lock.unlock();
  sdbus::Signal signal = object.createSignal(request_interface, "Response");
  answer(signal);
  object.emitSignal(signal);
}

void FakePortal::rewrite(const std::function<void(Script&)>& change) {
  const std::lock_guard lock(mutex_);
  change(script_);
}

FakePortal::Script FakePortal::script() const {
  const std::lock_guard lock(mutex_);
  return script_;
}

void FakePortal::note(const std::function<void(Seen&)>& what) {
  {
    const std::lock_guard lock(mutex_);
    what(seen_);
  }
  changed_.notify_all();
}

std::string FakePortal::waiting_request() const {
  const std::lock_guard lock(mutex_);
  return waiting_;
}

FakePortal::Seen FakePortal::seen() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

bool FakePortal::has_seen(const std::function<bool(const Seen&)>& wanted) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return wanted(seen_); });
}

}  // namespace telehug
