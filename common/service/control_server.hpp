// SPDX-License-Identifier: Apache-2.0
//
// The local socket of a daemon: requests are answered, watchers are told events. Lines of JSON, one object a line:
//   -> {"command":"status"}      <- {"side":"active", ...}          whatever the command's handler returns
//   -> {"command":"nonsense"}    <- {"error":"one sentence"}
//   -> {"command":"watch"}       <- {"watching":true}, then an object an event; a watcher that reads too slowly misses
//                                   the oldest and is told how many: {"event":"dropped","count":3}
// common/ctl/README.md documents the commands of the two daemons.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "common/clock.hpp"

namespace telehug {

// Who asks (SO_PEERCRED: as the kernel saw it when the connection was made).
struct Caller {
  pid_t pid = 0;
  uid_t uid = 0;
  gid_t gid = 0;
};

struct ControlServerOptions {
  std::filesystem::path socket;
  std::string group;  // see ControlSocket
  std::size_t most_clients = 16;
  std::size_t most_request_bytes = 65'536;
  std::size_t most_waiting_events = 256;  // per watcher
  Duration half_request_timeout = 10s;    // from a request's first byte to its end
  Duration idle_timeout = 60s;            // without a request, unless watching
  Duration write_timeout = 30s;           // one line that the client does not read
};

struct ControlServerStats {
  std::size_t clients = 0;
  std::size_t watchers = 0;
  std::uint64_t requests = 0;
  std::uint64_t refused_clients = 0;
  std::uint64_t malformed_requests = 0;
  std::uint64_t dropped_events = 0;  // of all watchers together
};

class ControlServer {
 public:
  // Handlers run in the server's thread, one at a time: they must be quick, and lock what they share. What they throw
  // becomes an error reply. An object with the key "error" is an error reply, too.
  using Handler = std::function<nlohmann::json(const nlohmann::json& request)>;
  using CallerHandler = std::function<nlohmann::json(const nlohmann::json& request, const Caller& caller)>;

  // Takes the socket; see ControlSocket for what it throws. Nobody is answered before start().
  explicit ControlServer(ControlServerOptions options);
  ~ControlServer();  // ends the thread, closes all connections, removes the socket
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  // Only before start(). "watch" is the server's own.
  void on(const std::string& command, Handler handler);
  void on(const std::string& command, CallerHandler handler);

  void start();

  // A request of this program itself, such as of the pages that it serves: answered like one of the socket, on the
  // server's thread, which also calls `answered`. From any thread. Never answered if this ends before. "watch" is none
  // of these.
  void ask(nlohmann::json request, std::function<void(nlohmann::json)> answered);

  // To every watcher. From any thread; never waits for a reader. Costs next to nothing while nobody watches.
  void broadcast(nlohmann::json event);

  // Whether a broadcast would be read by anybody: for events that are costly to put together.
  [[nodiscard]] bool has_watchers() const noexcept;

  [[nodiscard]] ControlServerStats stats() const noexcept;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace telehug
