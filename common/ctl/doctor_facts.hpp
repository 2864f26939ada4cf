// SPDX-License-Identifier: Apache-2.0
//
// What `telehug doctor` looks at, as values: gathered in one place, judged in another.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/config_report.hpp"

namespace telehug {

struct DeviceNode {
  std::string path;
  bool usable = false;  // by this user, to read and write
};

struct MonitorSize {
  std::string name;  // "HDMI-A-1"
  double width_mm = 0;
  double height_mm = 0;
};

struct CalibrationFacts {
  std::string file;
  bool there = false;
  std::string trouble;  // why it can't be read
  double width_mm = 0;  // of the visible screen
  double height_mm = 0;
};

struct PairFacts {
  std::string id;
  double days_left = 0;
  std::vector<std::pair<std::string, std::string>> faults;  // what, and what to do
};

struct FolderFacts {
  std::string path;
  bool there = false;
  bool usable = false;       // or, where it is not there yet, can be made
  bool open_to_all = false;  // others than its owner may look into it
  std::uint64_t free_bytes = 0;
};

struct SideFacts {
  Side side = Side::active;
  std::vector<Fault> config_faults;
  std::vector<PairFacts> pairs;
  std::string pairs_trouble;
  FolderFacts state;
  int domain = 77;
};

struct DoctorFacts {
  std::vector<SideFacts> sides;
  // active side
  bool wants_webcam = false;
  std::string configured_camera;  // empty: the only one
  std::vector<DeviceNode> cameras;
  CalibrationFacts calibration;
  std::vector<MonitorSize> monitors;  // that are connected
  bool wants_screen = false;
  bool pins_window = false;
  bool x11 = false;
  bool wayland = false;
  // passive side
  std::string serial_port;  // as configured; "auto"; empty: the jacket has none
  std::vector<DeviceNode> serial_ports;
  bool wants_bluetooth = false;
  int bluetooth_adapters = 0;
  bool bluetooth_blocked = false;  // rfkill(8)
  // this PC
  std::string kernel;  // /proc/version
  std::optional<bool> clock_synchronised;
  std::vector<int> udp_ports;           // in use on this PC
  std::optional<std::string> firewall;  // nft's ruleset, if this user may read it
  bool may_read_firewall = false;
  std::vector<nlohmann::json> daemons;  // their status
};

// `root`: where the files of the system begin, "/" but for tests.
[[nodiscard]] DoctorFacts gather_facts(const std::vector<Side>& sides, const ConfigSources& sources,
                                       const std::filesystem::path& root);

}  // namespace telehug
