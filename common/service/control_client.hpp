// SPDX-License-Identifier: Apache-2.0
//
// The other end of control_server.hpp: for the `telehug` command, the demo and tests. Waits, but never without a limit.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>

#include "common/clock.hpp"
#include "common/result.hpp"

namespace telehug {

enum class ConnectFailure {
  absent,      // nobody listens there
  permission,  // this user may not
  other,
};

class ControlClient {
 public:
  [[nodiscard]] static std::variant<ControlClient, ConnectFailure> connect(const std::filesystem::path& socket);

  ~ControlClient();
  ControlClient(ControlClient&& other) noexcept;
  ControlClient& operator=(ControlClient&& other) noexcept;

  // Sends a request and returns the reply, which may hold an "error". The error is of the conversation: no answer in
  // time, or not in JSON.
  [[nodiscard]] Result<nlohmann::json> ask(const nlohmann::json& request, Duration longest = 3s);

  // The next line that has come or comes in time, such as an event after "watch"; an error if the daemon is gone or
  // does not speak JSON.
  [[nodiscard]] Result<std::optional<nlohmann::json>> next(Duration longest);

  [[nodiscard]] int fd() const noexcept { return fd_; }

 private:
  explicit ControlClient(int fd) : fd_(fd) {}
  [[nodiscard]] bool wait_for(short events, Timestamp deadline) const;
  [[nodiscard]] bool send(const std::string& text, Timestamp deadline) const;

  int fd_ = -1;
  std::string received_;
};

}  // namespace telehug
