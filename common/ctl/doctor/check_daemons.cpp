// SPDX-License-Identifier: Apache-2.0
//
// Daemons, their units, and all checks in their order.
#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "ctl/doctor/checks.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

std::string systemctl(const UnitFacts& unit, const std::string& order) {
  return fmt::format("{} {} {}", unit.user ? "systemctl --user" : "sudo systemctl", order, unit.name);
}

std::string journalctl(const UnitFacts& unit) {
  return fmt::format("journalctl {} {} -e", unit.user ? "--user-unit" : "-u", unit.name);
}

Finding unit_finding(const UnitFacts& unit) {
  if (unit.active == "failed")
    return {"unit", Level::fail, fmt::format("{} has failed ({})", unit.name, unit.result),
            fmt::format("{} tells why; mend that, then {}", journalctl(unit), systemctl(unit, "restart"))};
  if (unit.active == "activating" && unit.restarts > 0)
    return {"unit", Level::fail,
            fmt::format("{} ends again and again ({}; {} restarts)", unit.name, unit.result, unit.restarts),
            journalctl(unit) + " tells why"};
  if (unit.active != "active" && unit.enabled != "enabled")
    return {"unit", Level::warn, fmt::format("{} is not started, nor will it be after the next start", unit.name),
            systemctl(unit, "enable --now")};
  if (unit.active != "active") return {"unit", Level::warn, unit.name + " is not started", systemctl(unit, "start")};
  if (unit.enabled == "disabled")
    return {"unit", Level::warn, unit.name + " runs, but will not after the next start", systemctl(unit, "enable")};
  return {"unit", Level::ok, unit.name + " runs", {}};
}

bool is_idle(const UnitFacts& unit) {
  return unit.active == "inactive" && unit.enabled != "enabled";
}

bool has_unit(const SideFacts& side) {
  return std::ranges::any_of(side.units, [](const UnitFacts& unit) { return unit.load == "loaded"; });
}

void add_daemon(Findings& findings, const nlohmann::json& status) {
  const std::string name = "telehug-" + status.value("side", "");
  const auto problems = status.value("problems", nlohmann::json::array());
  // Else it goes on by itself, or somebody wants it so.
  const Level level = status.value("state", "") == "fault" ? Level::fail : Level::warn;
  for (const auto& problem : problems)
    findings.push_back(
        {"daemon", level, fmt::format("{}: {}", name, problem.value("what", "")), problem.value("do", "")});
  if (problems.empty()) findings.push_back({"daemon", Level::ok, name + " runs and has no complaint", {}});
  if (!status.value("peer", nlohmann::json::object()).value("connected", false))
    findings.push_back(
        {"peer", Level::warn, name + ": the other PC is not connected",
         "is its daemon running? `telehug status` there, and /usr/share/doc/telehug-common/docs/between-homes.md"});
  else
    findings.push_back({"peer", Level::ok, name + ": the other PC is connected", {}});
  const auto jacket = status.value("jacket", nlohmann::json::object());
  const int firmware =
      jacket.contains("firmware") && jacket["firmware"].is_number_integer() ? jacket["firmware"].get<int>() : 0;
  if (firmware <= 0) return;  // it answers nothing
  if (firmware < newest_firmware)
    findings.push_back({"firmware", Level::warn,
                        fmt::format("the jacket's firmware is version {}; {} is the newest", firmware, newest_firmware),
                        "stop telehug-passive, then telehug jacket flash"});
  else
    findings.push_back({"firmware", Level::ok, fmt::format("version {}", firmware), {}});
}

}  // namespace

const SideFacts* find_side(const DoctorFacts& facts, Side side) {
  const auto found = std::ranges::find(facts.sides, side, &SideFacts::side);
  return found == facts.sides.end() ? nullptr : &*found;
}

bool talks(const DoctorFacts& facts, Side side) {
  return std::ranges::any_of(facts.daemons,
                             [&](const auto& status) { return status.value("side", "") == side_name(side); });
}

Findings check_units(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides) {
    // Of the two that the active side has one is enough; who runs it by hand needs none.
    const bool one_is_used =
        std::ranges::any_of(side.units, [](const UnitFacts& u) { return u.load == "loaded" && !is_idle(u); });
    for (const UnitFacts& unit : side.units) {
      if (unit.load != "loaded") continue;
      if (is_idle(unit) && (one_is_used || talks(facts, side.side) || &unit != &side.units.front())) continue;
      findings.push_back(unit_finding(unit));
    }
  }
  return findings;
}

Findings check_daemons(const DoctorFacts& facts) {
  Findings findings;
  for (const Side side : facts.not_of_root)
    findings.push_back({"daemon", Level::warn,
                        fmt::format("telehug-{} is not the system's, and root can't tell whose", side_name(side)),
                        fmt::format("telehug doctor {}, without sudo", side_name(side))});
  for (const SideFacts& side : facts.sides)
    if (!side.denied_socket.empty())
      findings.push_back({"daemon", Level::warn,
                          fmt::format("telehug-{} is there, but {} may not be used by {}", side_name(side.side),
                                      side.denied_socket, facts.asked_by),
                          fmt::format("sudo usermod -aG telehug {}, then log in again", facts.asked_by)});
    else if (!talks(facts, side.side))
      findings.push_back({"daemon", Level::warn, fmt::format("telehug-{} does not run", side_name(side.side)),
                          has_unit(side) ? "see unit, or telehug-" + side_name(side.side) + " run"
                                         : fmt::format("telehug-{} run", side_name(side.side))});
  for (const auto& [what, fix] : facts.unreachable_daemons)
    findings.push_back({"daemon", Level::warn, what, fix});
  for (const auto& status : facts.daemons)
    add_daemon(findings, status);
  return findings;
}

Findings all_checks(const DoctorFacts& facts) {
  Findings all;
  for (const auto check : {check_config,  check_camera,       check_light,  check_monitor,    check_calibration,
                           check_session, check_jacket,       check_serial, check_bootloader, check_bluetooth,
                           check_kernel,  check_clock,        check_ports,  check_firewall,   check_peers,
                           check_pairs,   check_state_folder, check_disk,   check_units,      check_daemons}) {
    Findings more = check(facts);
    std::move(more.begin(), more.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace telehug
