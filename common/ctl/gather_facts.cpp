// SPDX-License-Identifier: Apache-2.0
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/timex.h>
#include <unistd.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "config/locator.hpp"
#include "config/places.hpp"
#include "ctl/daemons.hpp"
#include "ctl/doctor_facts.hpp"
#include "ctl/run_program.hpp"
#include "files/text_file.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem))
    found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

// As the configuration names it: without the root.
DeviceNode node(const fs::path& root, const fs::path& path) {
  return {("/" / path.lexically_relative(root)).string(), ::access(path.c_str(), R_OK | W_OK) == 0};
}

void add_named(std::vector<DeviceNode>& nodes, const fs::path& root, const std::string& name) {
  if (name.empty() || name == "auto") return;
  const fs::path path = root / fs::path(name).relative_path();
  std::error_code ignored;
  const bool known = std::any_of(nodes.begin(), nodes.end(), [&](const DeviceNode& n) { return n.path == name; });
  if (!known && fs::exists(path, ignored)) nodes.push_back(node(root, path));
}

CalibrationFacts calibration_at(const fs::path& file) {
  CalibrationFacts facts;
  facts.file = file.string();
  std::error_code ignored;
  facts.there = fs::exists(file, ignored);
  if (!facts.there) return facts;
  auto text = read_text_file(file);
  if (!text) {
    facts.trouble = text.error().message;
    return facts;
  }
  try {
    const toml::table table = toml::parse(*text);
    facts.width_mm = table["screen"]["width_mm"].value_or(0.0);
    facts.height_mm = table["screen"]["height_mm"].value_or(0.0);
    if (facts.width_mm <= 0 || facts.height_mm <= 0) facts.trouble = "it has no size of the screen";
  } catch (const toml::parse_error& problem) {
    facts.trouble = problem.description();
  }
  return facts;
}

// VESA E-EDID 1.4, 3.10.2: the first detailed timing (byte 54) tells the picture's size in mm.
std::vector<MonitorSize> connected_monitors(const fs::path& root) {
  std::vector<MonitorSize> monitors;
  for (const fs::path& connector : entries(root / "sys/class/drm")) {
    const std::string edid = content_of(connector / "edid");
    if (edid.size() < 128 || !content_of(connector / "status").starts_with("connected")) continue;
    const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(edid[at])); };
    const unsigned width = byte(66) | (byte(68) >> 4) << 8;
    const unsigned height = byte(67) | (byte(68) & 0xF) << 8;
    const std::string name = connector.filename().string();
    if (width > 0 && height > 0)
      monitors.push_back({name.substr(name.find('-') + 1), static_cast<double>(width), static_cast<double>(height)});
  }
  return monitors;
}

// /proc/net/udp: "  sl  local_address rem_address ...", the address as hexadecimal ADDRESS:PORT.
std::vector<int> used_udp_ports(const fs::path& root) {
  std::vector<int> ports;
  std::istringstream lines(content_of(root / "proc/net/udp"));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string number;
    std::string address;
    fields >> number >> address;
    const std::size_t colon = address.find(':');
    if (colon != std::string::npos)
      ports.push_back(static_cast<int>(std::strtol(address.c_str() + colon + 1, nullptr, 16)));
  }
  return ports;
}

FolderFacts folder_at(const fs::path& folder) {
  FolderFacts facts;
  facts.path = folder.string();
  std::error_code ignored;
  facts.there = fs::exists(folder, ignored);
  fs::path existing = folder;
  while (!existing.empty() && existing != "/" && !fs::exists(existing, ignored))
    existing = existing.parent_path();
  facts.usable = ::access(existing.c_str(), W_OK | X_OK) == 0;
  struct stat status {};
  facts.open_to_all = facts.there && ::stat(folder.c_str(), &status) == 0 && (status.st_mode & 0077) != 0;
  struct statvfs space {};
  if (::statvfs(existing.c_str(), &space) == 0) facts.free_bytes = std::uint64_t{space.f_bavail} * space.f_frsize;
  return facts;
}

void add_pairs(SideFacts& facts, const fs::path& folder) {
  try {
    const PairStore store(folder, facts.side);
    const WallTime now = wall_time();
    for (const Pair& pair : store.list()) {
      PairFacts& about = facts.pairs.emplace_back();
      about.id = pair.id;
      about.days_left = std::chrono::duration<double, std::ratio<86400>>(pair.expires - now).count();
      for (const PairingFault& fault : store.preflight(pair, now))
        about.faults.emplace_back(fault.what, fault.to_do);
    }
  } catch (const std::runtime_error& problem) {
    facts.pairs_trouble = problem.what();
  }
}

SideFacts side_facts(Side side, const ConfigSources& sources, const PeerConfig& peer) {
  SideFacts facts;
  facts.side = side;
  facts.config_faults = inspect_config(sources, side).faults;
  facts.domain = peer.domain;
  const fs::path pairs = pairs_folder(peer, side);
  facts.state = folder_at(pairs);
  add_pairs(facts, pairs);
  return facts;
}

void add_active(DoctorFacts& facts, const ConfigSources& sources, const fs::path& root) {
  const auto loaded = load_active_config(sources);
  const ActiveConfig config = loaded ? *loaded : ActiveConfig{};
  facts.sides.push_back(side_facts(Side::active, sources, config.peer));
  const auto source = parse_camera_source(config.camera.source);
  facts.wants_webcam = source && source->kind == CameraSourceKind::webcam;
  facts.configured_camera = config.camera.device;
  for (const fs::path& device : entries(root / "dev"))
    if (device.filename().string().starts_with("video")) facts.cameras.push_back(node(root, device));
  add_named(facts.cameras, root, config.camera.device);
  facts.calibration = calibration_at(rig_file(config.rig));
  facts.monitors = connected_monitors(root);
  const auto screen = parse_screen_source(config.body_map.source);
  facts.wants_screen = screen && config.body_map.picture.empty() &&
                       (screen->kind == ScreenSourceKind::automatic || screen->kind == ScreenSourceKind::x11 ||
                        screen->kind == ScreenSourceKind::portal);
  facts.pins_window = !config.body_map.window.empty();
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  facts.x11 = set("DISPLAY");
  facts.wayland = set("WAYLAND_DISPLAY");
}

void add_passive(DoctorFacts& facts, const ConfigSources& sources, const fs::path& root) {
  const auto loaded = load_passive_config(sources);
  const PassiveConfig config = loaded ? *loaded : PassiveConfig{};
  facts.sides.push_back(side_facts(Side::passive, sources, config.peer));
  const auto link = parse_jacket_link(config.jacket.link);
  facts.wants_bluetooth = link && link->kind == JacketLinkKind::bluetooth;
  if (link && link->kind == JacketLinkKind::serial) facts.serial_port = link->path;
  for (const fs::path& port : entries(root / "dev/serial/by-id"))
    facts.serial_ports.push_back(node(root, port));
  add_named(facts.serial_ports, root, facts.serial_port);
  facts.bluetooth_adapters = static_cast<int>(entries(root / "sys/class/bluetooth").size());
  for (const fs::path& one : entries(root / "sys/class/rfkill"))
    if (content_of(one / "type").starts_with("bluetooth") &&
        (content_of(one / "soft").starts_with("1") || content_of(one / "hard").starts_with("1")))
      facts.bluetooth_blocked = true;
}

void add_firewall(DoctorFacts& facts) {
  const auto run = run_program({"nft", "list", "ruleset"}, 5s, "there is no nft");
  if (!run) return;
  facts.may_read_firewall = run->code == 0;
  facts.firewall = run->output;
}

void add_daemons(DoctorFacts& facts) {
  for (Daemon& daemon : find_daemons({}).found) {
    auto status = daemon.client.ask({{"command", "status"}});
    if (status && status->is_object() && !status->contains("error")) facts.daemons.push_back(*std::move(status));
  }
}

}  // namespace

DoctorFacts gather_facts(const std::vector<Side>& sides, const ConfigSources& sources, const fs::path& root) {
  DoctorFacts facts;
  for (const Side side : sides)
    side == Side::active ? add_active(facts, sources, root) : add_passive(facts, sources, root);
  facts.kernel = content_of(root / "proc/version");
  timex clock{};
  if (const int state = ::adjtimex(&clock); state >= 0) facts.clock_synchronised = state != TIME_ERROR;
  facts.udp_ports = used_udp_ports(root);
  add_firewall(facts);
  add_daemons(facts);
  return facts;
}

}  // namespace telehug
