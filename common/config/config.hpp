// SPDX-License-Identifier: Apache-2.0
//
// What each side can be told by its configuration. The values written here are the defaults; the tables of keys
// (key.hpp) say for every one its name in the file, its range and its help.
#pragma once

#include <string>

#include "common/units.hpp"

namespace telehug {

struct PeerConfig {
  int domain = 77;        // DDS domain
  std::string partition;  // DDS partition: pairs on one network that must not hear each other take different ones
  bool loopback_only = false;
  std::string pairs;           // read it with parse_pairs(); see memberships()
  std::string pairs_folder;    // see pairs_folder()
  std::string addresses;       // read it with parse_addresses(); only if not loopback_only
  std::string public_address;  // IPv4, of the router that forwards UDP ports to this PC; empty: none does
  int public_port = 0;         // the first of two; 0 without public_address
};

struct ControlConfig {
  std::string socket;     // empty: default_control_socket()
  std::string group;      // empty: the daemon's own
  std::string stop_file;  // empty: see stop_file()
};

struct WebConfig {
  bool enabled = true;
  int port = 0;  // 0: the kernel chooses one
  bool metrics = false;
};

struct LogConfig {
  std::string level = "info";
};

struct CameraConfig {
  std::string source = "webcam";  // read it with parse_camera_source()
  std::string device;             // empty: the first by name
  int width_px = 1280;
  int height_px = 720;
  int fps = 30;
  std::string preset = "auto";  // keep, thesis, auto
  int power_line_hz = 0;        // 0, 50, 60
};

struct RigConfig {
  std::string calibration_file;  // empty: see rig_file()
  ScreenSize screen;             // 0: as the calibration file says
};

struct TouchConfig {
  std::string detector = "default";  // default, thesis
  std::string model = "default";     // default, thesis
  int up_after_ms = 70;
};

struct LocalTouchConfig {
  bool uinput = false;
  bool tuio = false;
  std::string tuio_host = "127.0.0.1";
  int tuio_port = 3333;
};

struct BodyMapConfig {
  std::string source = "auto";  // read it with parse_screen_source()
  std::string picture;          // file or folder
  std::string monitor;          // RandR's name; empty: the primary one
  std::string window;           // part of a title or class; empty: none is pinned
  std::string region;           // read it with parse_screen_region()
  bool mirrored = false;
  std::string face = "blaze";  // blaze, haar
  double rate_hz = 8;
  int hold_ms = 1500;
  int max_age_ms = 3000;
};

struct SendingConfig {
  std::string at_start = "auto";  // auto, on, off
  bool only_in_front = true;
  std::string hotkey;  // such as "Ctrl+Alt+H"; empty: none
};

struct OverlayConfig {
  bool show = false;
};

struct HugConfig {
  bool notify = true;
};

struct FeedbackConfig {
  std::string link;  // empty: none; read it with parse_jacket_link()
  std::string profile = "ring-1.toml";
  double strength = 0.6;  // 0..1
};

struct ActiveConfig {
  CameraConfig camera;
  RigConfig rig;
  TouchConfig touch;
  LocalTouchConfig local_touch;
  BodyMapConfig body_map;
  SendingConfig sending;
  OverlayConfig overlay;
  HugConfig hug;
  FeedbackConfig feedback;
  PeerConfig peer;
  int heartbeat_timeout_ms = 250;  // [peer]
  ControlConfig control;
  WebConfig web;
  LogConfig log;
};

struct JacketConfig {
  std::string profile;                     // empty: see jacket_profile_file()
  std::string overrides;                   // file; empty: none
  std::string link = "simulated";          // read it with parse_jacket_link()
  int baud = 0;                            // 0: the profile's
  std::string several_senders = "merged";  // merged, exclusive
};

struct SafetyConfig {
  double max_strength = 1.0;  // 0..1
  int drive_ms = 200;
  int heartbeat_timeout_ms = 250;
  double max_celsius = 40;
};

struct ConsentConfig {
  std::string quiet_hours;  // read it with parse_quiet_hours()
  std::string file;         // empty: see consent_file()
};

// Lines are named by their number or their name; empty: there is none.
struct GpioConfig {
  std::string chip;  // path, name or label; "simulated:DIR"
  std::string stop_button_line;
  bool stop_button_active_low = false;
  int stop_button_resume_s = 5;  // 0: never
  std::string hug_button_line;
  bool hug_button_active_low = true;
  std::string button_pull = "up";  // up, down, none
  int debounce_ms = 10;
  std::string power_line;
  bool power_active_low = false;
  std::string led_line;
  bool led_active_low = false;
};

struct PassiveConfig {
  JacketConfig jacket;
  SafetyConfig safety;
  ConsentConfig consent;
  GpioConfig gpio;
  PeerConfig peer;
  ControlConfig control;
  WebConfig web;
  LogConfig log;
};

}  // namespace telehug
