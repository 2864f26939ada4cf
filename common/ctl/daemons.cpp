// SPDX-License-Identifier: Apache-2.0
#include "ctl/daemons.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <set>

#include "ctl/plain_text.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

std::vector<std::filesystem::path> places(const DaemonChoice& choice) {
  if (!choice.socket.empty()) return {choice.socket};
  std::vector<std::filesystem::path> sockets;
  for (const Side side : {Side::active, Side::passive}) {
    if (!choice.side.empty() && choice.side != side_name(side)) continue;
    const auto usual = usual_control_sockets(side);
    sockets.insert(sockets.end(), usual.begin(), usual.end());
  }
  return sockets;
}

std::string nobody_there(const DaemonChoice& choice) {
  if (!choice.socket.empty()) return fmt::format("no telehug daemon answers on {}", choice.socket);
  const std::string which = choice.side.empty() ? "telehug daemon" : fmt::format("telehug-{}", choice.side);
  return fmt::format(
      "no {} is running on this PC: start telehug-active or telehug-passive, or give its socket with --socket", which);
}

}  // namespace

void add_daemon_options(CLI::App& command, DaemonChoice& choice) {
  command.add_option("--side", choice.side, "Only this side's daemon (default: every daemon found on this PC)")
      ->check(CLI::IsMember({"active", "passive"}));
  add_socket_option(command, choice);
}

void add_socket_option(CLI::App& command, DaemonChoice& choice) {
  command.add_option("--socket", choice.socket, "The daemon's local socket (default: the usual places)")
      ->type_name("SOCKET");
}

Daemons find_daemons(const DaemonChoice& choice) {
  Daemons daemons;
  std::set<std::filesystem::path> tried;  // as root two of the usual places can be one
  for (const auto& socket : places(choice)) {
    if (!tried.insert(socket).second) continue;
    auto attempt = ControlClient::connect(socket);
    if (auto* client = std::get_if<ControlClient>(&attempt)) {
      daemons.found.push_back({socket, std::move(*client)});
    } else if (std::get<ConnectFailure>(attempt) == ConnectFailure::permission) {
      daemons.unreachable.push_back(
          {ExitCode::permission,
           fmt::format("the socket {} may not be used by this user: ask as root, or join the group that owns it",
                       socket.string()),
           socket});
    } else if (std::get<ConnectFailure>(attempt) == ConnectFailure::other) {
      daemons.unreachable.push_back(
          {ExitCode::bad_answer,
           fmt::format("the socket {} does not take connections: try again, or restart its daemon", socket.string()),
           socket});
    }
  }
  if (daemons.found.empty() && daemons.unreachable.empty()) {
    daemons.unreachable.push_back({ExitCode::not_running, nobody_there(choice), {}});
  }
  return daemons;
}

ExitCode complain_of_unreachable(const Daemons& daemons) {
  for (const Unreachable& daemon : daemons.unreachable) {
    fmt::print(stderr, "telehug: {}\n", plain_text(daemon.sentence));
  }
  return daemons.unreachable.empty() ? ExitCode::ok : daemons.unreachable.front().code;
}

ExitCode complain(const Daemon& daemon, ExitCode code, const std::string& sentence) {
  fmt::print(stderr, "telehug: {}: {}\n", daemon.socket.string(), plain_text(sentence));
  return code;
}

ExitCode tell_all(const DaemonChoice& choice, const nlohmann::json& request, const std::string& done) {
  Daemons daemons = find_daemons(choice);
  ExitCode result = complain_of_unreachable(daemons);
  for (Daemon& daemon : daemons.found) {
    const auto reply = daemon.client.ask(request);
    if (!reply) {
      result = complain(daemon, ExitCode::bad_answer, reply.error().message);
    } else if (reply->contains("error")) {
      result = complain(daemon, ExitCode::refused, text_of((*reply)["error"]));
    } else {
      fmt::print("{}: {}\n", reply->contains("side") ? text_of((*reply)["side"]) : daemon.socket.string(), done);
    }
  }
  return result;
}

}  // namespace telehug
