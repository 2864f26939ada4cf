// SPDX-License-Identifier: Apache-2.0
#include "demo_world.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "peer/session_id.hpp"

namespace telehug {
namespace {

constexpr Duration longest_start = 60s;

std::filesystem::path make_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "telehug-demo-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder can be made for the demo at " + name);
  return name;
}

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

template <typename Condition>
void wait_until(Condition condition, const std::string& what) {
  const auto deadline = std::chrono::steady_clock::now() + longest_start;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error(what);
    std::this_thread::sleep_for(20ms);
  }
}

}  // namespace

DemoWorld::DemoWorld(const DemoSettings& settings)
    : settings_(settings),
      folder_(make_folder()),
      active_socket_(folder_ / "active.sock"),
      passive_socket_(folder_ / "passive.sock"),
      partition_("demo-" + new_session_id()) {
  const std::string port = folder_ / "jacket";
  jacket_ = std::make_unique<ChildProcess>(
      std::vector<std::string>{program("telehug-jacket-sim"), "--link", port, "--pins", pins()},
      folder_ / "jacket.log");
  wait_until([&] { return std::filesystem::exists(port); },
             "the simulated jacket does not start:\n" + content(folder_ / "jacket.log"));
  std::vector<std::string> passive{program("telehug-passive"), "run", "--config", "/dev/null"};
  for (const std::string& value : peer_settings())
    passive.insert(passive.end(), {"--set", value});
  for (const std::string& value :
       {"jacket.link=serial:" + port, "jacket.profile=" + settings_.profile.string(),
        "consent.file=" + (folder_ / "consent.json").string(), "control.socket=" + passive_socket_.string(),
        "control.stop_file=" + (folder_ / "stop-passive.json").string(), "log.level=" + settings_.active_level}) {
    passive.insert(passive.end(), {"--set", value});
  }
  passive_ = std::make_unique<ChildProcess>(passive, folder_ / "passive.log");
  calibrate();
  wait_for_jacket();
}

DemoWorld::~DemoWorld() {
  (void)end();
  std::error_code ignored;
  if (!keep_) std::filesystem::remove_all(folder_, ignored);
}

std::vector<std::string> DemoWorld::peer_settings() const {
  return {"peer.partition=" + partition_, "peer.loopback_only=true",
          "peer.pairs_folder=" + (folder_ / "pairs").string()};
}

void DemoWorld::calibrate() const {
  ChildProcess calibration({program("telehug-active"), "calibrate", "--config", "/dev/null", "--source",
                            settings_.source, "--out", folder_ / "rig.toml"},
                           folder_ / "calibrate.log");
  wait_until([&] { return !calibration.runs(); }, "the calibration does not end");
  if (calibration.end() != 0)
    throw std::runtime_error("the calibration failed:\n" + content(folder_ / "calibrate.log"));
}

void DemoWorld::wait_for_jacket() const {
  std::string problem = "telehug-passive does not answer:\n" + content(folder_ / "passive.log");
  wait_until(
      [&] {
        auto client = ControlClient::connect(passive_socket_);
        if (!std::holds_alternative<ControlClient>(client)) return false;
        const auto status = std::get<ControlClient>(client).ask({{"command", "status"}});
        return status && status->contains("jacket") && (*status)["jacket"].value("state", "") == "armed";
      },
      "the jacket is not ready; see " + (folder_ / "passive.log").string());
}

void DemoWorld::start_active() {
  std::vector<std::string> active{program("telehug-active"), "run",   "--config", "/dev/null", "--source",
                                  settings_.source,          "--loop"};
  for (const std::string& value : peer_settings())
    active.insert(active.end(), {"--set", value});
  for (const std::string& value :
       {"rig.calibration_file=" + (folder_ / "rig.toml").string(),
        "body_map.picture=" + settings_.chat_picture.string(), "control.socket=" + active_socket_.string(),
        "control.stop_file=" + (folder_ / "stop-active.json").string(), "log.level=" + settings_.active_level}) {
    active.insert(active.end(), {"--set", value});
  }
  active_ = std::make_unique<ChildProcess>(active, folder_ / "active.log");
}

ControlClient DemoWorld::connect(const std::filesystem::path& socket) const {
  std::optional<ControlClient> connected;
  wait_until(
      [&] {
        auto client = ControlClient::connect(socket);
        if (auto* open = std::get_if<ControlClient>(&client)) connected.emplace(std::move(*open));
        return connected.has_value();
      },
      "nobody answers on " + socket.string() + "; see the logs in " + folder_.string());
  return *std::move(connected);
}

void DemoWorld::check_all_run() {
  const auto check = [this](const std::unique_ptr<ChildProcess>& child, const char* name) {
    if (child && !child->runs()) {
      throw std::runtime_error(fmt::format("{} has ended:\n{}", name, content(folder_ / (std::string(name) + ".log"))));
    }
  };
  check(jacket_, "jacket");
  check(passive_, "passive");
  check(active_, "active");
}

bool DemoWorld::end() {
  bool well = true;
  for (auto* child : {&active_, &passive_, &jacket_}) {
    if (*child) well = (*child)->end() == 0 && well;
    child->reset();
  }
  return well;
}

}  // namespace telehug
