// SPDX-License-Identifier: Apache-2.0
//
// What a daemon's web server answers: values in, values out, no sockets.
//   GET  /enter?link=SECRET     once: opens a session and leads to /
//   GET  /NAME                  the embedded file; / is index.html
//   GET  /texts.json[?lang=de]  all texts of the pages in one language
//   GET  /live?topics=a,b       server-sent events: the newest of these topics, and what they become
//   GET  /picture/NAME          the newest of a live picture, as a JPEG; 204 if there is none at present
//   POST /command               a request as on the local socket (common/ctl/README.md), of those that pages may send
//   GET  /metrics               if switched on: counters and latencies as OpenMetrics text, without a cookie
// All but the first and the last need the session's cookie, and all pass request_rules.hpp before.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/clock.hpp"
#include "web/entrance.hpp"
#include "web/request_rules.hpp"
#include "web/web_files.hpp"

namespace telehug {

// As their files are called: texts.en.json. The first is for those who read none of them.
inline constexpr std::string_view web_languages[] = {"en", "de", "fr"};

struct WebAnswer {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> headers = {};
};
// To be answered with what the daemon says to it.
struct WebCommand {
  nlohmann::json request;
  bool metrics = false;  // of what the daemon says, the metrics' text alone is the answer
};
struct WebStream {
  std::vector<std::string> topics;
};

struct WebReply {
  std::variant<WebAnswer, WebCommand, WebStream> what;
  bool known = false;  // whoever asks has a session
};

// The newest of a picture that goes on changing, as a whole JPEG file; null if there is none at present. Called in the
// server's thread whenever a page asks for it, so that it is made only while somebody looks: it must not wait.
using LivePicture = std::function<std::shared_ptr<const std::string>()>;

struct WebSiteOptions {
  std::string cookie;                                // its name: cookies know no ports, and a PC may run both sides
  std::set<std::string> commands;                    // that pages may send
  std::set<std::string> topics;                      // that they may follow
  std::map<std::string, LivePicture> pictures = {};  // by the names that pages ask for
  bool metrics = false;                              // served, to whoever on this PC asks
};

class WebSite {
 public:
  // Throws std::invalid_argument if a file of texts is missing or is none: {"key": "text"}.
  WebSite(WebSiteOptions options, WebFiles files);

  // One thread.
  [[nodiscard]] WebReply reply(const WebRequest& request, std::uint16_t port, Timestamp now);

  // Any thread: the path and query of a new link.
  [[nodiscard]] std::string new_link(Timestamp now);

  // For refusals that come before there is a request: what is sent is too long, or no HTTP.
  [[nodiscard]] static WebAnswer refusal(unsigned status, std::string_view why);

 private:
  [[nodiscard]] WebAnswer enter(const WebRequest& request, Timestamp now);
  [[nodiscard]] WebAnswer shut_door(const WebRequest& request, unsigned status, const std::string& why) const;
  [[nodiscard]] WebAnswer file(const WebRequest& request) const;
  [[nodiscard]] WebAnswer picture(const std::string& name) const;
  [[nodiscard]] WebAnswer texts(const WebRequest& request) const;
  [[nodiscard]] std::variant<WebAnswer, WebCommand, WebStream> stream(const WebRequest& request) const;
  [[nodiscard]] std::variant<WebAnswer, WebCommand, WebStream> command(const WebRequest& request) const;

  WebSiteOptions options_;
  WebFiles files_;
  std::map<std::string_view, nlohmann::json> texts_;  // by language
  Entrance entrance_;
};

}  // namespace telehug
