// SPDX-License-Identifier: Apache-2.0
//
// What runs here, and as whom.
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

#include "config/places.hpp"
#include "ctl/doctor/gather.hpp"
#include "ctl/run_program.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr const char* service_account = "telehug";  // sysusers.d/telehug.conf

std::map<std::string, std::string> properties(const std::string& text) {
  std::map<std::string, std::string> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t equals = line.find('='); equals != std::string::npos)
      all[line.substr(0, equals)] = line.substr(equals + 1);
  return all;
}

std::optional<UnitFacts> ask_unit(const std::string& name, bool user) {
  std::vector<std::string> command{"systemctl", "show", name,
                                   "--property=LoadState,ActiveState,UnitFileState,Result,NRestarts"};
  if (user) command.insert(command.begin() + 1, "--user");
  const auto run = run_program(command, 5s, "there is no systemctl");
  if (!run || run->code != 0) return std::nullopt;
  auto told = properties(run->output);
  UnitFacts unit;
  unit.name = name;
  unit.user = user;
  unit.load = told["LoadState"];
  unit.active = told["ActiveState"];
  unit.enabled = told["UnitFileState"];
  unit.result = told["Result"];
  unit.restarts = std::atoi(told["NRestarts"].c_str());
  return unit;
}

bool is_configured(const ConfigSources& sources, Side side) {
  return !sources.only_file && !config_files(sources, side).empty();
}

bool is_used(const ConfigSources& sources, Side side) {
  std::error_code ignored;
  if (side == Side::passive) return !entries(pairs_folder(readable_passive_config(sources).peer, side)).empty();
  const ActiveConfig config = readable_active_config(sources);
  return !entries(pairs_folder(config.peer, side)).empty() || fs::exists(rig_file(config.rig), ignored);
}

}  // namespace

std::vector<UnitFacts> units_of(Side side, const fs::path& root) {
  std::error_code ignored;
  if (!fs::exists(root / "run/systemd/system", ignored)) return {};  // sd_booted(3)
  std::vector<UnitFacts> units;
  if (side == Side::active)
    if (auto unit = ask_unit("telehug-active.service", true)) units.push_back(*std::move(unit));
  if (auto unit = ask_unit(std::string(system_unit(side)) + ".service", false)) units.push_back(*std::move(unit));
  return units;
}

Account account_of(const std::vector<UnitFacts>& units, bool system) {
  const bool by_system = std::ranges::any_of(units, [](const UnitFacts& unit) {
    return !unit.user && unit.load == "loaded" && (unit.active != "inactive" || unit.enabled == "enabled");
  });
  Account self = own_account();
  if ((!system && !by_system) || self.name == service_account) return self;
  return ::getpwnam(service_account) == nullptr ? self : Account{service_account, false, true};
}

fs::path installed_program(const std::string& name) {
  std::error_code ignored;
  fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / name;
  if (fs::exists(beside, ignored)) return beside;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path program = fs::path(folder) / name; ::access(program.c_str(), X_OK) == 0) return program;
  return {};
}

std::vector<Side> sides_here(const ConfigSources& sources, const std::vector<nlohmann::json>& daemons) {
  std::vector<Side> used;
  std::vector<Side> installed;
  for (const Side side : {Side::active, Side::passive}) {
    const bool runs =
        std::ranges::any_of(daemons, [&](const auto& status) { return status.value("side", "") == side_name(side); });
    const bool there = !installed_program("telehug-" + side_name(side)).empty();
    if (there) installed.push_back(side);
    // Without its program its configuration is what a package has left behind.
    if (runs || (there && (is_configured(sources, side) || is_used(sources, side)))) used.push_back(side);
  }
  if (!used.empty()) return used;
  return installed.empty() ? std::vector{Side::active, Side::passive} : installed;
}

}  // namespace telehug
