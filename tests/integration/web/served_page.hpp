// SPDX-License-Identifier: Apache-2.0
//
// A web server with one page, and what a test needs to speak with it.
#pragma once

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "integration/web/raw_browser.hpp"
#include "web/web_server.hpp"

namespace telehug {

inline constexpr EmbeddedFile served_files[] = {
    {"index.html", "<p>page"},
    {"texts.en.json", "{}"},
    {"texts.de.json", "{}"},
    {"texts.fr.json", "{}"},
    {"shared/texts.en.json", R"({"door.no_session":"come in","door.link_used":"used"})"},
    {"shared/texts.de.json", R"({"door.no_session":"","door.link_used":""})"},
    {"shared/texts.fr.json", R"({"door.no_session":"","door.link_used":""})"},
};

inline bool eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

inline double resident_mb() {
  long pages = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

class TheWebServer : public testing::Test {
 protected:
  void begin() {
    server.emplace(
        options,
        WebSiteOptions{
            "telehug-test", {"echo", "silence"}, {"news", "weather"}, {{"camera.jpg", [this] { return picture; }}}},
        WebFiles({served_files}),
        [this](const nlohmann::json& request, const WebServer::Answered& answered) {
          ++asked;
          if (request.at("command") == "echo") answered(request);
        },
        clock);
    server->start();
  }
  void serve() {
    begin();
    const std::string link = server->new_link();
    const std::string path = link.substr(link.find('/', 7));
    const std::string answer = ask("GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    const auto begin = answer.find("telehug-test=");
    cookie = "Cookie: " + answer.substr(begin, answer.find(';', begin) - begin) + "\r\n";
  }
  [[nodiscard]] std::string host() const { return fmt::format("127.0.0.1:{}", server->port()); }
  // A request whose header lines are right, but for those given.
  [[nodiscard]] std::string get(const std::string& path, const std::string& lines = "") const {
    return "GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n" + cookie + lines + "\r\n";
  }
  [[nodiscard]] std::string post(const std::string& body) const {
    return fmt::format(
        "POST /command HTTP/1.1\r\nHost: {0}\r\nOrigin: http://{0}\r\nContent-Type: application/json\r\n{1}"
        "Content-Length: {2}\r\n\r\n{3}",
        host(), cookie, body.size(), body);
  }
  // On a connection of its own.
  [[nodiscard]] std::string ask(const std::string& request) const {
    RawBrowser browser(server->port());
    browser.send(request);
    return browser.read_answer();
  }

  const SteadyClock clock;
  WebServerOptions options;
  std::optional<WebServer> server;
  std::string cookie;
  std::atomic<int> asked{0};
  std::shared_ptr<const std::string> picture;  // before begin()
};

}  // namespace telehug
