// SPDX-License-Identifier: Apache-2.0
//
// The `telehug` program as a process of its own, against a control server in this one.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "doubles/temporary_folder.hpp"
#include "service/control_server.hpp"
#include "service/control_socket.hpp"

namespace telehug {

struct Outcome {
  int code = -1;
  std::string out;
  std::string errors;
};

class TelehugCommand : public testing::Test {
 protected:
  TelehugCommand() { std::filesystem::create_directories(runtime_ / "telehug"); }

  // With $XDG_RUNTIME_DIR in the test's own folder; `prefix` runs it with fewer rights or without a network.
  Outcome run(const std::string& arguments, const std::string& prefix = "") {
    const auto out = folder_.path() / "out.txt";
    const auto errors = folder_.path() / "errors.txt";
    const std::string line = prefix + " env XDG_RUNTIME_DIR=" + runtime_.string() + " " TELEHUG_BIN "/telehug " +
                             arguments + " >" + out.string() + " 2>" + errors.string();
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(errors)};
  }

  static std::string content(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  std::unique_ptr<ControlServer> daemon(Side side, nlohmann::json status) {
    auto server = std::make_unique<ControlServer>(
        ControlServerOptions{.socket = runtime_ / "telehug" / (side_name(side) + ".sock"), .group = {}});
    server->on("status", [status](const nlohmann::json&) { return status; });
    server->on("stop", [this, side](const nlohmann::json& request) -> nlohmann::json {
      reason_ = request.value("reason", "");
      return {{"side", side_name(side)}};
    });
    server->on("hug", [this, side](const nlohmann::json& request) -> nlohmann::json {
      hug_ = request;
      return {{"side", side_name(side)}};
    });
    for (const char* order : {"pause", "unpause", "mute", "unmute", "strength", "quiet"}) {
      server->on(order, [this, side](const nlohmann::json& request) -> nlohmann::json {
        order_ = request;
        return {{"side", side_name(side)}};
      });
    }
    server->on("open", [side](const nlohmann::json&) -> nlohmann::json {
      return {{"url", "http://127.0.0.1:4000/enter?link=" + side_name(side)}};
    });
    server->on("resume", [](const nlohmann::json&) -> nlohmann::json {
      return {{"error", "the other side has stopped"}};
    });
    server->start();
    return server;
  }

  TemporaryFolder folder_;
  std::filesystem::path runtime_ = folder_.path() / "run";
  std::string reason_;
  nlohmann::json hug_;
  nlohmann::json order_;
};

}  // namespace telehug
