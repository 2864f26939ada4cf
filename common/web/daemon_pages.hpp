// SPDX-License-Identifier: Apache-2.0
//
// The pages of a daemon: its web server, tied to its local socket. Pages send what the local socket takes, and are
// answered by the same handlers, on the control server's thread.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "config/config.hpp"
#include "service/control_server.hpp"
#include "web/web_server.hpp"

namespace telehug {

struct DaemonPagesOptions {
  Side side = Side::active;
  std::set<std::string> commands;                    // of the local socket, that pages may send
  std::set<std::string> topics;                      // that pages may follow
  std::map<std::string, LivePicture> pictures = {};  // that they may look at; called until stop()
  std::span<const EmbeddedFile> files = {};          // beside those that both sides share, which are below "shared/"
};

class DaemonPages {
 public:
  // Adds the command "open" to `control`, whose handlers use this: stop() comes before the end of `control`, and that
  // before the end of this. A port that can't be had is no reason to have no
  // daemon: problem() tells it.
  DaemonPages(const WebConfig& config, const DaemonPagesOptions& options, ControlServer& control, const Clock& clock);

  void start();
  void stop();

  // --- any thread ---

  // See WebServer.
  void tell(const std::string& topic, const nlohmann::json& news);
  [[nodiscard]] bool has_followers() const noexcept { return server_ && server_->has_followers(); }
  [[nodiscard]] bool has_followers(const std::string& topic) const { return server_ && server_->has_followers(topic); }

  // For status: "web" with the port and the names of the pages, and a problem if there is one.
  void add_status(nlohmann::json& status) const;

 private:
  [[nodiscard]] nlohmann::json open();

  const Side side_;
  std::vector<std::string> pages_;     // "index.html"
  std::unique_ptr<WebServer> server_;  // null: switched off, or problem_ tells why not
  std::string problem_;
};

}  // namespace telehug
