// SPDX-License-Identifier: Apache-2.0
#include "ctl/doctor_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "service/control_socket.hpp"

namespace telehug {
namespace {

bool has(const DoctorFacts& facts, Side side) {
  return std::any_of(facts.sides.begin(), facts.sides.end(), [&](const SideFacts& s) { return s.side == side; });
}

bool talks(const DoctorFacts& facts, Side side) {
  return std::any_of(facts.daemons.begin(), facts.daemons.end(),
                     [&](const auto& status) { return status.value("side", "") == side_name(side); });
}

// One finding for a device that was named, or for the only one there should be.
Finding device_finding(const std::string& check, const std::string& thing, const std::string& wanted,
                       const std::vector<DeviceNode>& nodes, const std::string& group) {
  const auto node =
      wanted.empty() ? nodes.begin()
                     : std::find_if(nodes.begin(), nodes.end(), [&](const DeviceNode& n) { return n.path == wanted; });
  if (node == nodes.end()) {
    return wanted.empty()
               ? Finding{check, Level::fail, fmt::format("there is no {}", thing), "plug it in; it is found by itself"}
               : Finding{check, Level::fail, fmt::format("{} is not there", wanted),
                         fmt::format("plug the {} in, or correct its name in the configuration", thing)};
  }
  if (!node->usable) {
    return {check, Level::fail, fmt::format("{} may not be used by this user", node->path),
            fmt::format("sudo usermod -aG {} \"$USER\", then log in again", group)};
  }
  return {check, Level::ok, fmt::format("{} can be used", node->path), {}};
}

bool about(double a, double b) {
  return std::abs(a - b) <= 0.03 * std::max(a, b);  // EDID rounds; a border's width is more
}

}  // namespace

Findings check_config(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides) {
    if (side.config_faults.empty())
      findings.push_back({"config", Level::ok, side_name(side.side) + ": no fault in the configuration", {}});
    for (const Fault& fault : side.config_faults)
      findings.push_back({"config", Level::fail, fmt::format("{}: {}", fault.where, fault.what),
                          "correct that line; `telehug config check` tells whether it is right"});
  }
  return findings;
}

Findings check_camera(const DoctorFacts& facts) {
  if (!has(facts, Side::active) || !facts.wants_webcam) return {};
  return {device_finding("camera", "webcam", facts.configured_camera, facts.cameras, "video")};
}

Findings check_calibration(const DoctorFacts& facts) {
  if (!has(facts, Side::active)) return {};
  const CalibrationFacts& rig = facts.calibration;
  if (!rig.there)
    return {{"calibration", Level::fail, fmt::format("there is no calibration at {}", rig.file),
             "telehug-active calibrate --width-mm WIDTH --height-mm HEIGHT"}};
  if (!rig.trouble.empty())
    return {{"calibration", Level::fail, fmt::format("{}: {}", rig.file, rig.trouble), "telehug-active calibrate"}};
  if (facts.monitors.empty())
    return {{"calibration", Level::ok, "there is one; no monitor tells its size, to compare with", {}}};
  for (const MonitorSize& monitor : facts.monitors)
    if (about(monitor.width_mm, rig.width_mm) && about(monitor.height_mm, rig.height_mm))
      return {{"calibration", Level::ok, fmt::format("fits the monitor {}", monitor.name), {}}};
  const MonitorSize& monitor = facts.monitors.front();
  return {{"calibration", Level::warn,
           fmt::format("it is of a screen of {:.0f} x {:.0f} mm; the monitor {} has {:.0f} x {:.0f} mm", rig.width_mm,
                       rig.height_mm, monitor.name, monitor.width_mm, monitor.height_mm),
           "measure the visible picture; if the monitor is another one, run telehug-active calibrate"}};
}

Findings check_session(const DoctorFacts& facts) {
  if (!has(facts, Side::active) || !facts.wants_screen) return {};
  if (facts.x11 && !facts.wayland) return {{"screen", Level::ok, "an X11 desktop", {}}};
  if (!facts.wayland)
    return {{"screen", Level::fail, "there is no desktop to look at in this session",
             "run telehug-active in the session of the person at the monitor"}};
  if (facts.pins_window)
    return {{"screen", Level::warn, "on a Wayland desktop no window can be pinned (body_map.window)",
             "share the monitor when the desktop asks, and use `telehug send on`; or log in to an X11 session"}};
  return {{"screen", Level::ok, "a Wayland desktop; touches go out after `telehug send on`", {}}};
}

Findings check_serial(const DoctorFacts& facts) {
  if (!has(facts, Side::passive) || facts.serial_port.empty()) return {};
  const bool any = facts.serial_port == "auto";
  if (any && facts.serial_ports.size() > 1)
    return {{"jacket port", Level::fail, "there are several serial ports, and jacket.link is serial:auto",
             "name the jacket's in jacket.link, as in /dev/serial/by-id"}};
  return {device_finding("jacket port", "jacket", any ? "" : facts.serial_port, facts.serial_ports, "dialout")};
}

Findings check_bluetooth(const DoctorFacts& facts) {
  if (!has(facts, Side::passive) || !facts.wants_bluetooth) return {};
  if (facts.bluetooth_adapters == 0)
    return {
        {"bluetooth", Level::fail, "this PC has no Bluetooth adapter", "plug one in, or use the jacket's USB cable"}};
  if (facts.bluetooth_blocked)
    return {{"bluetooth", Level::fail, "Bluetooth is switched off", "rfkill unblock bluetooth"}};
  return {{"bluetooth", Level::ok, "there is an adapter that is on", {}}};
}

Findings check_kernel(const DoctorFacts& facts) {
  // passive_side/wire/README.md: RFCOMM is dead after the first connection that fails.
  if (facts.wants_bluetooth && facts.kernel.find("Debian 6.1.192-2") != std::string::npos)
    return {{"kernel", Level::fail, "this kernel (6.1.192-2) crashes its Bluetooth when the jacket is off",
             "boot linux-image-6.1.0-50, or 6.12 from the backports"}};
  return {{"kernel", Level::ok, "none that is known to be bad for telehug", {}}};
}

Findings check_clock(const DoctorFacts& facts) {
  if (!facts.clock_synchronised) return {};
  if (*facts.clock_synchronised) return {{"clock", Level::ok, "synchronised", {}}};
  return {{"clock", Level::warn, "this PC's clock is not synchronised; a wrong date makes certificates invalid",
           "timedatectl set-ntp true"}};
}

Findings check_ports(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides) {
    if (talks(facts, side.side)) continue;  // they are its own
    // DDSI-RTPS 2.2, 9.6.1.1: port base 7400, domain gain 250; two for each of fifteen participants.
    const int first = 7400 + 250 * side.domain;
    for (const int port : facts.udp_ports)
      if (port >= first && port < first + 30 && facts.daemons.empty())
        return {{"ports", Level::warn, fmt::format("another program uses the UDP port {} of telehug's", port),
                 "`ss -ulpn` tells which; end it, or set peer.domain to another number on both PCs"}};
  }
  if (!facts.sides.empty()) findings.push_back({"ports", Level::ok, "telehug's are free, or its own", {}});
  return findings;
}

Findings check_firewall(const DoctorFacts& facts) {
  if (!facts.firewall) return {};
  if (!facts.may_read_firewall)
    return {{"firewall", Level::warn, "this user may not read its rules",
             "run `sudo telehug doctor` to have them checked"}};
  const std::string& rules = *facts.firewall;
  const std::size_t input = rules.find("hook input");
  const std::size_t end = input == std::string::npos ? input : rules.find('\n', input);
  const bool drops =
      input != std::string::npos && rules.substr(input, end - input).find("policy drop") != std::string::npos;
  for (const SideFacts& side : facts.sides) {
    const std::string port = fmt::format("{}", 7400 + 250 * side.domain);
    if (drops && rules.find(port) == std::string::npos)
      return {{"firewall", Level::fail, fmt::format("it drops what comes in, and has no rule for UDP port {}", port),
               "let UDP ports " + port + " and the 29 above it in from the other PC (docs/between-homes.md)"}};
  }
  return {{"firewall", Level::ok, "lets telehug's ports in", {}}};
}

Findings check_pairs(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides) {
    if (!side.pairs_trouble.empty()) {
      findings.push_back({"pairs", Level::fail, side.pairs_trouble, "run it as the user whose pairs they are"});
      continue;
    }
    if (side.pairs.empty())
      findings.push_back({"pairs", Level::warn,
                          side_name(side.side) + ": there is no pair: only this PC itself is heard",
                          "telehug pair invite here, telehug pair accept on the other PC"});
    for (const PairFacts& pair : side.pairs) {
      for (const auto& [what, fix] : pair.faults)
        findings.push_back({"pairs", Level::fail, fmt::format("{}: {}", pair.id, what), fix});
      if (!pair.faults.empty()) continue;
      if (pair.days_left < 14)
        findings.push_back({"pairs", Level::warn, fmt::format("{} ends in {:.0f} days", pair.id, pair.days_left),
                            "let both PCs connect, which renews it; by hand: telehug pair renew on the wearer's PC"});
      else
        findings.push_back(
            {"pairs", Level::ok, fmt::format("{} is valid for {:.0f} days", pair.id, pair.days_left), {}});
    }
  }
  return findings;
}

Findings check_state_folder(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides) {
    const FolderFacts& folder = side.state;
    if (!folder.usable)
      findings.push_back({"state folder", Level::fail, folder.path + " can't be written by this user",
                          fmt::format("sudo chown -R \"$USER\" {}", folder.path)});
    else if (folder.open_to_all)
      findings.push_back({"state folder", Level::fail, folder.path + " holds private keys, and others may look into it",
                          "chmod 700 " + folder.path});
    else
      findings.push_back({"state folder", Level::ok, folder.path, {}});
  }
  return findings;
}

Findings check_disk(const DoctorFacts& facts) {
  constexpr std::uint64_t little = 20 << 20;
  for (const SideFacts& side : facts.sides)
    if (side.state.free_bytes < little)
      return {{"disk", Level::fail,
               fmt::format("only {} MiB are free at {}", side.state.free_bytes >> 20, side.state.path),
               "make room: what the wearer wants and new pairs can't be kept otherwise"}};
  return {{"disk", Level::ok, "has room", {}}};
}

Findings check_daemons(const DoctorFacts& facts) {
  Findings findings;
  for (const SideFacts& side : facts.sides)
    if (!talks(facts, side.side))
      findings.push_back({"daemon", Level::warn, fmt::format("telehug-{} does not run", side_name(side.side)),
                          fmt::format("telehug-{} run", side_name(side.side))});
  for (const auto& status : facts.daemons) {
    const std::string name = "telehug-" + status.value("side", "");
    const auto problems = status.value("problems", nlohmann::json::array());
    for (const auto& problem : problems)
      findings.push_back(
          {"daemon", Level::fail, fmt::format("{}: {}", name, problem.value("what", "")), problem.value("do", "")});
    if (problems.empty()) findings.push_back({"daemon", Level::ok, name + " runs and has no complaint", {}});
    if (!status.value("peer", nlohmann::json::object()).value("connected", false))
      findings.push_back({"peer", Level::warn, name + ": the other PC is not connected",
                          "is its daemon running? `telehug status` there, and docs/between-homes.md"});
    else
      findings.push_back({"peer", Level::ok, name + ": the other PC is connected", {}});
    const auto jacket = status.value("jacket", nlohmann::json::object());
    if (jacket.contains("firmware") && jacket["firmware"].is_number_integer() && jacket["firmware"] < newest_firmware)
      findings.push_back({"firmware", Level::warn,
                          fmt::format("the jacket's firmware is version {}; {} is the newest",
                                      jacket["firmware"].get<int>(), newest_firmware),
                          "stop telehug-passive, then telehug jacket flash"});
  }
  return findings;
}

Findings all_checks(const DoctorFacts& facts) {
  Findings all;
  for (const auto check :
       {check_config, check_camera, check_calibration, check_session, check_serial, check_bluetooth, check_kernel,
        check_clock, check_ports, check_firewall, check_pairs, check_state_folder, check_disk, check_daemons}) {
    Findings more = check(facts);
    std::move(more.begin(), more.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace telehug
