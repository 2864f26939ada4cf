// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdbus-c++/sdbus-c++.h>

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

// A desktop that shows notifications, as the Desktop Notifications Specification 1.2 describes it.
class FakeNotifications {
 public:
  struct Seen {
    std::string app;
    std::uint32_t replaces = 0;
    std::string title;
    std::string body;
    std::map<std::string, sdbus::Variant> hints;
    std::uint32_t id = 0;  // as answered
  };

  struct Script {
    std::vector<std::string> capabilities = {"body", "body-markup", "sound"};
    bool refuses = false;
    bool answers = true;
  };

  FakeNotifications(const std::string& bus_address, Script script)
      : script_(std::move(script)), connection_(sdbus::createSessionBusConnectionWithAddress(bus_address)) {
    object_ = sdbus::createObject(*connection_, "/org/freedesktop/Notifications");
    object_->registerMethod("GetCapabilities").onInterface(name).implementedAs([this] { return script_.capabilities; });
    object_->registerMethod("Notify").onInterface(name).implementedAs(
        [this](sdbus::Result<std::uint32_t>&& reply, const std::string& app, std::uint32_t replaces, const std::string&,
               const std::string& title, const std::string& body, const std::vector<std::string>&,
               const std::map<std::string, sdbus::Variant>& hints, std::int32_t) {
          notify(std::move(reply), {app, replaces, title, body, hints, 0});
        });
    object_->finishRegistration();
    connection_->requestName(name);
    connection_->enterEventLoopAsync();
  }
  ~FakeNotifications() {
    connection_->leaveEventLoop();
    connection_->releaseName(name);  // waits for it: the next one shall get it
  }
  FakeNotifications(const FakeNotifications&) = delete;
  FakeNotifications& operator=(const FakeNotifications&) = delete;

  // Waits until so many were to be shown.
  [[nodiscard]] bool has_seen(std::size_t count) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 10s, [&] { return seen_.size() >= count; });
  }
  [[nodiscard]] std::vector<Seen> seen() const {
    const std::lock_guard lock(mutex_);
    return seen_;
  }

 private:
  static constexpr const char* name = "org.freedesktop.Notifications";

  void notify(sdbus::Result<std::uint32_t>&& reply, Seen seen) {
    if (script_.refuses) return reply.returnError(sdbus::Error("org.example.Refused", "not today"));
    {
      const std::lock_guard lock(mutex_);
      seen.id = seen.replaces != 0 ? seen.replaces : next_id_++;
      seen_.push_back(seen);
    }
    changed_.notify_all();
    if (script_.answers) reply.returnResults(seen.id);
  }

  const Script script_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::vector<Seen> seen_;
  std::uint32_t next_id_ = 41;
  std::unique_ptr<sdbus::IConnection> connection_;
  std::unique_ptr<sdbus::IObject> object_;
};

}  // namespace telehug
