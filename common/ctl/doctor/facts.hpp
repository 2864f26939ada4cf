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
  bool usable = false;  // by the side's account, to read and write
};

struct MonitorSize {
  std::string name;  // "HDMI-A-1"
  double width_mm = 0;
  double height_mm = 0;
};

struct CalibrationFacts {
  std::string file;
  bool there = false;
  bool secret = false;  // from the user who asks: it is the service's
  std::string trouble;  // why it can't be read
  double width_mm = 0;  // of the visible screen
  double height_mm = 0;
  int width_px = 0;  // of the camera's pictures; 0: it does not tell
  int height_px = 0;
};

// What `telehug-active camera check` measured.
struct LightFacts {
  std::string problem;  // why there are no pictures; empty: there are
  double mean = 0;      // of grey, 0..1
  double dark_share = 0;
  double blown_share = 0;  // of the picture
  double flicker = 0;      // how much the mean changes from picture to picture, as a share of it
  double rate_hz = 0;
  double asked_hz = 0;
};

struct PairFacts {
  std::string id;
  double days_left = 0;
  std::vector<std::pair<std::string, std::string>> faults;  // what, and what to do
};

struct FolderFacts {
  std::string path;
  bool there = false;
  bool usable = false;       // by the side's account or, where it is not there yet, can be made
  bool open_to_all = false;  // others than its owner may look into it
  std::string owner;         // of it, or of the folder in which it would be
  std::uint64_t free_bytes = 0;
};

// Who runs a side's daemon.
struct Account {
  std::string name;
  bool self = true;      // the user who asks
  bool service = false;  // nobody logs in as it
};

// Of a systemd unit, as systemctl(1) tells.
struct UnitFacts {
  std::string name;  // "telehug-passive.service"
  bool user = false;
  std::string load;     // "loaded", "not-found"
  std::string active;   // "active", "failed", "inactive"
  std::string enabled;  // "enabled", "disabled", ""
  std::string result;   // "success", "exit-code", "watchdog", ...
  int restarts = 0;
};

enum class PeerAnswer { refused, silent, unreachable, no_route };

struct PeerProbe {
  std::string address;
  PeerAnswer answer = PeerAnswer::silent;
};

// The system's unit of a side, without ".service"; the active side's is a fixed rig's. The user's is
// telehug-active alone.
[[nodiscard]] constexpr const char* system_unit(Side side) {
  return side == Side::active ? "telehug-active-rig" : "telehug-passive";
}

struct SideFacts {
  Side side = Side::active;
  Account account;
  std::vector<Fault> config_faults;
  std::vector<PairFacts> pairs;
  std::string pairs_trouble;
  bool pairs_secret = false;  // from the user who asks
  FolderFacts state;
  int domain = 77;
  bool loopback_only = false;
  std::vector<PeerProbe> peers;  // of the configured addresses, while the other PC is not connected
  int web_port = 0;              // 0: the kernel chooses one
  std::vector<UnitFacts> units;
  std::string denied_socket;  // of its daemon, which is there and this user may not ask; empty: it is not so
};

enum class BootloaderKind { not_asked, none, good, old };

struct DoctorFacts {
  std::vector<SideFacts> sides;
  // active side
  std::string configured_camera;  // empty: the only one
  std::vector<DeviceNode> cameras;
  int picture_width_px = 0;  // as configured
  int picture_height_px = 0;
  std::optional<LightFacts> light;  // nothing: nobody could look
  CalibrationFacts calibration;
  std::vector<MonitorSize> monitors;      // that are connected and tell it
  double configured_screen_width_mm = 0;  // 0: it is not configured
  std::string display;                    // of X11; empty: none
  std::string wayland;                    // its display; empty: none
  bool wants_webcam = false;
  bool wants_screen = false;
  bool pins_window = false;
  bool display_answers = false;
  bool wayland_answers = false;
  std::string portal_trouble;  // why no screen can be shared through the desktop's portal; empty: it can
  // passive side
  std::string serial_port;  // as configured; "auto"; empty: the jacket has none
  std::vector<DeviceNode> serial_ports;
  std::string bootloader_text;  // its version, or why there is none
  BootloaderKind bootloader = BootloaderKind::not_asked;
  int bluetooth_adapters = 0;
  bool jacket_is_simulated = false;
  bool wants_bluetooth = false;
  bool bluetooth_blocked = false;  // rfkill(8)
  std::string bluez_trouble;       // "what; what to do"; empty: none
  // this PC
  std::string asked_by;  // the user
  // Sides that are not the system's on a PC whose other side is: root, who may look at that one, does not stand for
  // whom these are.
  std::vector<Side> not_of_root;
  std::string kernel;                      // /proc/version
  std::vector<int> udp_ports;              // in use on this PC
  std::vector<int> tcp_ports;              // that somebody listens on
  std::optional<nlohmann::json> firewall;  // nft's ruleset, if there is an nft and this user may read it
  std::optional<bool> clock_synchronised;
  bool through_sudo = false;
  bool firewall_is_secret = false;      // it may not
  bool legacy_firewall = false;         // there are rules of iptables that nft does not show
  std::vector<nlohmann::json> daemons;  // their status
  std::vector<std::pair<std::string, std::string>> unreachable_daemons;  // what, and what to do
};

struct DoctorWishes {
  std::vector<Side> sides;  // empty: those that this PC has
  ConfigSources sources;
  bool system = false;               // as the system's service sees it
  std::filesystem::path root = "/";  // where the files of the system begin, "/" but for tests
  bool ask_bootloader = false;       // resets the jacket's board
};

// Takes up to some seconds: it asks programs, daemons, the camera, the other PC. Under sudo(8) and on a PC none of
// whose sides is the system's service, the process is from then on the user's who asked: root has only read the
// firewall.
[[nodiscard]] DoctorFacts gather_facts(const DoctorWishes& wishes);

}  // namespace telehug
