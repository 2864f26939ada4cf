// SPDX-License-Identifier: Apache-2.0
//
// Pairing for a daemon's pages: what `telehug pair` does, asked for by the command "pairing" of the local socket
// (common/ctl/README.md).
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/messages.hpp"
#include "daemon/pairing_run.hpp"
#include "service/control_server.hpp"

namespace telehug {

class PairingDesk {
 public:
  // Adds the command "pairing" to `control`, which must end before this does. `folder`: of the pairs. `address`: where
  // this PC waits for the other one; empty: its own in the network.
  PairingDesk(Side side, std::filesystem::path folder, std::string address, ControlServer& control);

  // Any thread. If it has changed since it was last asked for: {"state": "idle"}; "inviting" and, once it is known,
  // "code", "qr" (a whole SVG) and "ends_s" (Unix time); "accepting"; "paired" with "pair"; "failed" with "problem".
  [[nodiscard]] std::optional<nlohmann::json> news();

 private:
  using Json = nlohmann::json;

  [[nodiscard]] Json obey(const Json& request);
  [[nodiscard]] Json list() const;
  [[nodiscard]] Json revoke(const Json& request) const;
  [[nodiscard]] Json begin(const Json& request, bool invites);
  [[nodiscard]] Json cancel();
  void heard(const Json& told);
  void over(const std::string& problem);

  const Side side_;
  const std::filesystem::path folder_;
  const std::string address_;
  std::mutex mutex_;  // guards what follows, but for run_
  Json state_ = {{"state", "idle"}};
  bool changed_ = true;
  bool runs_ = false;
  std::unique_ptr<PairingRun> run_;  // of the control server's thread; ends before what it tells
};

}  // namespace telehug
