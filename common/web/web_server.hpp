// SPDX-License-Identifier: Apache-2.0
//
// Serves a daemon's pages to this PC's browser, on 127.0.0.1 alone, in a thread of its own. Everything that comes from
// outside has a limit and a time, and so has what a client does not read.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "common/clock.hpp"
#include "web/web_site.hpp"

namespace telehug {

struct WebServerOptions {
  std::uint16_t port = 0;  // 0: the kernel chooses one
  // Of all connections. A further one takes the place of that of a stranger (without a session) which is there for
  // longest; if there is none it is turned away. So whoever opens connections without end keeps nobody out.
  std::size_t most_connections = 48;
  std::size_t most_streams = 12;  // of them
  std::uint32_t most_header_bytes = 8192;
  std::size_t most_body_bytes = 16'384;
  int stream_buffer_bytes = 65'536;  // of news that the kernel keeps for a client that does not read
  Duration stranger_timeout = 10s;   // without a whole request
  Duration request_timeout = 10s;    // from a request's first byte to its end
  Duration idle_timeout = 60s;       // between two requests
  Duration answer_timeout = 10s;     // of the daemon to a command
  Duration write_timeout = 10s;      // an answer, or an event, that the client does not read
};

struct WebServerStats {
  std::size_t connections = 0;
  std::size_t streams = 0;
  std::uint64_t requests = 0;
  std::uint64_t refused_requests = 0;     // answered with a status of 400 or more
  std::uint64_t refused_connections = 0;  // turned away or given up for another
};

class WebServer {
 public:
  // Sends a request to the daemon, which calls `answered` once at the most, from whatever thread, even after the
  // server's end.
  using Answered = std::function<void(nlohmann::json)>;
  using Ask = std::function<void(nlohmann::json request, Answered answered)>;

  // Listens, but answers nobody before start(). Throws std::runtime_error with a sentence if the port can't be had, and
  // what WebSite throws.
  WebServer(const WebServerOptions& options, WebSiteOptions site, WebFiles files, Ask ask, const Clock& clock);
  ~WebServer();  // as stop()
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  void start();
  // Closes all connections and ends the thread: nothing is asked of the daemon from here on. Links are still made, and
  // lead nowhere.
  void stop();

  [[nodiscard]] std::uint16_t port() const noexcept;

  // --- any thread ---

  // "http://127.0.0.1:PORT/...", which opens a session once within Entrance::link_lasts.
  [[nodiscard]] std::string new_link();

  // The newest of a topic, for all who follow it. Never waits for a reader.
  void tell(const std::string& topic, const nlohmann::json& news);
  // Whether anybody follows any: for news that are costly to put together.
  [[nodiscard]] bool has_followers() const noexcept;
  // Whether anybody follows this one. Throws std::out_of_range if there is no such topic.
  [[nodiscard]] bool has_followers(const std::string& topic) const;

  [[nodiscard]] WebServerStats stats() const noexcept;

 private:
  class Service;
  std::shared_ptr<Service> service_;
};

}  // namespace telehug
