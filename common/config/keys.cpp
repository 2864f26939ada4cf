// SPDX-License-Identifier: Apache-2.0
//
// The tables of all keys. After a change here: cmake --build --preset release --target config_files
#include <fmt/core.h>

#include <algorithm>

#include "config/key.hpp"
#include "config/locator.hpp"
#include "config/quiet_hours_text.hpp"

namespace telehug {
namespace {

constexpr Range any_length_px{0, 16384};
constexpr Range any_length_mm{0, 5000};
// Above 100 the UDP ports of a DDS domain (7400 + 250 * domain) lie where the kernel hands out ports of its own.
constexpr Range dds_domain{0, 100};
// A heartbeat comes every 100 ms: less than 150 would lose the peer whenever one is late.
constexpr Range heartbeat_timeout{150, 1000};
// What drives a motor trusts a silent sender for at most as long as one command of the jacket lasts.
constexpr Range heartbeat_timeout_of_drives{150, 250};

// There must be a next one.
constexpr Range forwarded_port{0, 65534};

template <typename Parser>
TextCheck parsed_by(Parser parse) {
  return [parse](std::string_view text) -> std::optional<std::string> {
    const auto parsed = parse(text);
    return parsed ? std::nullopt : std::optional(parsed.error().message);
  };
}

// In DDS these characters make a partition's name a pattern that matches other pairs' partitions.
std::optional<std::string> not_a_pattern(std::string_view text) {
  if (text.find_first_of("*?[]") == std::string_view::npos && text.size() <= 64) return std::nullopt;
  return "a partition has at most 64 characters and none of * ? [ ]";
}

// sockaddr_un has room for 108 bytes.
std::optional<std::string> fits_a_socket(std::string_view text) {
  if (text.size() < 108 && (text.empty() || text.starts_with('/'))) return std::nullopt;
  return "the path of a socket is absolute and shorter than 108 bytes";
}

// The kernel's names of lines and chips (GPIO_MAX_NAME_SIZE) are shorter than 32 bytes.
std::optional<std::string> names_a_line(std::string_view text) {
  const bool printable = std::ranges::all_of(text, [](char c) { return c > 0x20 && c < 0x7F && c != '/'; });
  if (text.size() < 32 && printable && text != "." && text != "..") return std::nullopt;
  return "a line is its number on the chip or its name: below 32 characters, no blanks or slashes";
}

std::optional<std::string> names_a_chip(std::string_view text) {
  constexpr std::string_view simulated = "simulated:";
  const bool one_line = std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) >= 0x20; });
  if (one_line && text != simulated) return std::nullopt;
  return "a GPIO chip is its path, name or label, or \"simulated:DIR\"";
}

using Rows = std::vector<Key>;

void append(Rows& rows, const Rows& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

Rows peer_rows(PeerConfig& c) {
  return {
      {"peer", "domain", &c.domain, "", dds_domain, "DDS domain; both sides need the same."},
      {"peer", "partition", &c.partition, "", TextCheck(not_a_pattern),
       "Name of this pair; both sides need the same. Pairs on one network take different names."},
      {"peer",
       "loopback_only",
       &c.loopback_only,
       "",
       {},
       "true: talk only to a peer on this PC, even if paired. Without a pair the network is never used."},
      {"peer", "pairs", &c.pairs, "", parsed_by(parse_pairs),
       "Which pairs this PC speaks to, by their ids (`telehug pair list`) with commas between them, or \"all\"; empty: "
       "on the wearer's PC all, on a parent's the only one."},
      {"peer",
       "pairs_folder",
       &c.pairs_folder,
       "",
       {},
       "Where the pairs of this PC are kept; empty: in the state folder of the service or user."},
      {"peer", "addresses", &c.addresses, "", parsed_by(parse_addresses),
       "IPv4 addresses of the other side, with commas between them, where it is not found by itself; \"ADDRESS:PORT\" "
       "if it has a public_port."},
      {"peer", "public_address", &c.public_address, "", parsed_by(parse_address),
       "IPv4 address by which the internet knows this home, if its router forwards two UDP ports to this PC; empty: "
       "none. docs/between-homes.md has the safer way."},
      {"peer", "public_port", &c.public_port, "", forwarded_port,
       "The first of the two forwarded ports, the next one being the second; 0 without public_address."},
  };
}

Rows common_rows(ControlConfig& control, WebConfig& web, LogConfig& log) {
  return {
      {"control", "socket", &control.socket, "", TextCheck(fits_a_socket),
       "Local socket that `telehug status` talks to; empty: in the runtime folder of the service or user."},
      {"control", "group", &control.group, "", {}, "Group that may use the socket; empty: the daemon's own."},
      {"web",
       "enabled",
       &web.enabled,
       "",
       {},
       "true: `telehug open` shows this side's pages in the browser of this PC; nobody else can reach them."},
      {"web", "port", &web.port, "", Range{0, 65535}, "TCP port of the pages, on 127.0.0.1 alone; 0: any free one."},
      {"log", "level", &log.level, "", OneOf{{"trace", "debug", "info", "warn", "error"}},
       "The least important messages that are logged."},
  };
}

std::string place_of(const std::vector<Key>& keys, std::initializer_list<std::string_view> paths) {
  for (const std::string_view path : paths) {
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.path() == path; });
    if (key != keys.end() && !key->origin.empty()) return key->origin;
  }
  return "defaults";
}

std::vector<Fault> impossible_peers(const PeerConfig& c, const std::vector<Key>& keys) {
  std::vector<Fault> faults;
  if (c.loopback_only && !c.addresses.empty()) {
    faults.push_back({place_of(keys, {"peer.addresses", "peer.loopback_only"}),
                      "peer.addresses are of the network, which peer.loopback_only = true forbids: set it to false, or "
                      "leave the addresses out"});
  }
  if (c.loopback_only && !c.public_address.empty()) {
    faults.push_back({place_of(keys, {"peer.public_address", "peer.loopback_only"}),
                      "peer.public_address is of the network, which peer.loopback_only = true forbids: set it to "
                      "false, or leave the address out"});
  }
  if (c.public_address.empty() != (c.public_port == 0)) {
    faults.push_back({place_of(keys, {"peer.public_address", "peer.public_port"}),
                      "peer.public_address and peer.public_port belong together: give both, or neither"});
  }
  return faults;
}

Rows gpio_rows(GpioConfig& c) {
  return {
      {"gpio", "chip", &c.chip, "", TextCheck(names_a_chip),
       "Chip with the jacket's own button, light and power line: path, name or label (gpiodetect shows them), or "
       "\"simulated:DIR\", whose lines are the files in DIR. Empty: none."},
      {"gpio", "stop_button_line", &c.stop_button_line, "", TextCheck(names_a_line),
       "Line of the emergency stop button, by number or name (gpioinfo shows them). Empty: none. If it is given and "
       "can't "
       "be had, telehug-passive does not start."},
      {"gpio",
       "stop_button_active_low",
       &c.stop_button_active_low,
       "",
       {},
       "false: pressed is high: a normally-closed button to ground with pull-up, where a broken cable counts as "
       "pressed "
       "(recommended). true: pressed is low: a normally-open button to ground, where a broken cable is not noticed."},
      {"gpio", "stop_button_resume_s", &c.stop_button_resume_s, "s", Range{0, 60},
       "While stopped, pressing the stop button again for so long and then letting go resumes. 0: only `telehug "
       "resume` "
       "does."},
      {"gpio", "hug_button_line", &c.hug_button_line, "", TextCheck(names_a_line),
       "Line of the button with which the wearer hugs back. Empty: none."},
      {"gpio",
       "hug_button_active_low",
       &c.hug_button_active_low,
       "",
       {},
       "true: pressed is low: a normally-open button to ground with pull-up."},
      {"gpio", "button_pull", &c.button_pull, "", OneOf{{"up", "down", "none"}},
       "Resistor inside the chip that both buttons' lines get; none: there is one outside."},
      {"gpio", "debounce_ms", &c.debounce_ms, "ms", Range{1, 25}, "A button's level counts after so long."},
      {"gpio", "power_line", &c.power_line, "", TextCheck(names_a_line),
       "Line that switches the motors' supply on while somebody can be felt; it needs a resistor to the level at which "
       "the "
       "supply is off. Empty: none. If it is given and can't be had, telehug-passive does not start."},
      {"gpio", "power_active_low", &c.power_active_low, "", {}, "true: low switches the supply on."},
      {"gpio", "led_line", &c.led_line, "", TextCheck(names_a_line),
       "Line of the status light. Dark: not running; a flash every 2 s: waits for the other side; steady: ready; "
       "double "
       "flashes: touched now; fast: stopped, or a problem. Empty: none."},
      {"gpio", "led_active_low", &c.led_active_low, "", {}, "true: low lights it."},
  };
}

// One line can't serve two ends; under both of its names it fails when it is requested.
std::vector<Fault> impossible_lines(const GpioConfig& c, const std::vector<Key>& keys) {
  std::vector<Fault> faults;
  const std::pair<std::string, const std::string*> lines[] = {{"gpio.stop_button_line", &c.stop_button_line},
                                                              {"gpio.hug_button_line", &c.hug_button_line},
                                                              {"gpio.power_line", &c.power_line},
                                                              {"gpio.led_line", &c.led_line}};
  for (auto line = std::begin(lines); line != std::end(lines); ++line) {
    if (line->second->empty()) continue;
    if (c.chip.empty()) {
      faults.push_back({place_of(keys, {line->first}),
                        fmt::format("{} is given, but gpio.chip is not: name the chip that has it", line->first)});
    }
    for (auto other = std::begin(lines); other != line; ++other) {
      if (*other->second != *line->second) continue;
      faults.push_back(
          {place_of(keys, {other->first, line->first}),
           fmt::format("{} and {} are both \"{}\": a line does one thing", other->first, line->first, *line->second)});
    }
  }
  if (c.stop_button_resume_s == 1) {
    faults.push_back({place_of(keys, {"gpio.stop_button_resume_s"}),
                      "gpio.stop_button_resume_s is 1: a press that resumes must be at least 2 s long, or never (0)"});
  }
  return faults;
}

}  // namespace

std::vector<Key> keys_of(ActiveConfig& c) {
  Rows rows{
      {"camera", "source", &c.camera.source, "", parsed_by(parse_camera_source),
       "\"webcam\", \"replay:DIR\" (a recording), \"virtual\" (a simulated rig) or \"virtual:SEED\" (one drawn at "
       "random)."},
      {"camera",
       "device",
       &c.camera.device,
       "",
       {},
       "The webcam, best by its /dev/v4l/by-id/ path; empty: the only camera there is."},
      {"camera", "width_px", &c.camera.width_px, "px", Range{160, 7680}, "Width of the camera's frames."},
      {"camera", "height_px", &c.camera.height_px, "px", Range{120, 4320}, "Height of the camera's frames."},
      {"camera", "fps", &c.camera.fps, "frames/s", Range{1, 240}, "Frame rate asked of the camera."},
      {"camera", "preset", &c.camera.preset, "", OneOf{{"auto", "thesis", "keep"}},
       "Settings of the camera while it is open. auto: what `telehug-active camera tune` found, if anything; thesis: "
       "exposure, white balance and focus fixed; keep: as they are."},
      {"camera", "power_line_hz", &c.camera.power_line_hz, "Hz", Range{0, 60},
       "What the light flickers with, so that pictures don't: 50 or 60; 0: as the camera is."},

      {"rig",
       "calibration_file",
       &c.rig.calibration_file,
       "",
       {},
       "Calibration of this monitor and camera; empty: rig.toml in the state folder of the service or user."},
      {"rig", "screen_width_mm", &c.rig.screen.width_mm, "mm", any_length_mm,
       "Visible width of the monitor: calibrated with, then compared; 0: as calibrated."},
      {"rig", "screen_height_mm", &c.rig.screen.height_mm, "mm", any_length_mm,
       "Visible height of the monitor: calibrated with, then compared; 0: as calibrated."},
      {"rig", "screen_width_px", &c.rig.screen.width_px, "px", any_length_px,
       "Width of the desktop, which a calibration notes; 0: unknown, or as calibrated."},
      {"rig", "screen_height_px", &c.rig.screen.height_px, "px", any_length_px,
       "Height of the desktop, which a calibration notes; 0: unknown, or as calibrated."},

      {"touch", "detector", &c.touch.detector, "", OneOf{{"default", "thesis"}},
       "How fingers are found; default: several, compared with how the rig looks with nobody there; thesis: one."},
      {"touch", "model", &c.touch.model, "", OneOf{{"default", "thesis"}},
       "How a finger in the image becomes a point on the screen; default: whatever the calibration holds; also what "
       "`calibrate` solves."},
      {"touch", "up_after_ms", &c.touch.up_after_ms, "ms", Range{0, 1000},
       "How long a finger must be unseen before its touch ends."},

      {"local_touch",
       "uinput",
       &c.local_touch.uinput,
       "",
       {},
       "true: the monitor is a touchscreen of this PC, too; needs the right to write /dev/uinput."},
      {"local_touch", "tuio", &c.local_touch.tuio, "", {}, "true: touches are sent as TUIO 1.1 cursors."},
      {"local_touch", "tuio_host", &c.local_touch.tuio_host, "", {}, "Where TUIO is sent to; it is not encrypted."},
      {"local_touch", "tuio_port", &c.local_touch.tuio_port, "", Range{1, 65535}, "And to which UDP port."},

      {"body_map", "source", &c.body_map.source, "", parsed_by(parse_screen_source),
       "Where the picture of the video chat comes from. \"auto\": `picture` if it is set, else this PC's screen; "
       "\"x11\" or \"portal\" (Wayland): the screen; \"picture\"; \"camera:DEVICE\": a capture card that shows the "
       "screen; \"replay:DIR\": a recording of the screen."},
      {"body_map",
       "picture",
       &c.body_map.picture,
       "",
       {},
       "Picture of the whole monitor with the remote person: a file, or a folder of them."},
      {"body_map",
       "monitor",
       &c.body_map.monitor,
       "",
       {},
       "x11: name of the monitor that the camera looks along, as `xrandr` tells it; empty: the primary one."},
      {"body_map",
       "window",
       &c.body_map.window,
       "",
       {},
       "x11: only this window is looked at: a part of its title or class; empty: the whole monitor."},
      {"body_map", "region", &c.body_map.region, "", parsed_by(parse_screen_region),
       "Only this part of the monitor is looked at: \"X,Y,WIDTH,HEIGHT\" in its pixels; empty: all of it."},
      {"body_map",
       "mirrored",
       &c.body_map.mirrored,
       "",
       {},
       "true: the chat shows the remote person as in a mirror, their left hand on the left."},
      {"body_map", "face", &c.body_map.face, "", OneOf{{"blaze", "haar"}},
       "Face finder: blaze, a small net, or haar, the thesis'."},
      {"body_map", "rate_hz", &c.body_map.rate_hz, "Hz", Range{2, 60}, "How often the face is looked for."},
      {"body_map", "hold_ms", &c.body_map.hold_ms, "ms", Range{0, 10000},
       "How long the last face found stays in use when none is found."},
      {"body_map", "max_age_ms", &c.body_map.max_age_ms, "ms", Range{100, 30000},
       "A body map older than this is refused: touches are counted, not sent."},

      {"sending", "at_start", &c.sending.at_start, "", OneOf{{"auto", "on", "off"}},
       "Whether touches go out before `telehug send` says so. auto: while the pinned window is in front; of a whole "
       "screen none."},
      {"sending",
       "only_in_front",
       &c.sending.only_in_front,
       "",
       {},
       "true: touches never go out while another window covers the pinned one."},
      {"sending",
       "hotkey",
       &c.sending.hotkey,
       "",
       {},
       "X11: keys that turn the sending off and on, such as \"Ctrl+Alt+H\"; empty: none."},

      {"overlay",
       "show",
       &c.overlay.show,
       "",
       {},
       "true: the touched box is outlined on the screen (X11), in red, and in green once the other side has felt it; "
       "the whole person in pink for a moment when they hug back."},

      {"hug",
       "notify",
       &c.hug.notify,
       "",
       {},
       "true: when the other side hugs back the desktop shows a notification, with a sound."},

      {"feedback", "link", &c.feedback.link, "", parsed_by(parse_optional_jacket_link),
       "A small actuator at the toucher's finger that answers when a touch was felt: as [jacket] link of the passive "
       "side; empty: none."},
      {"feedback",
       "profile",
       &c.feedback.profile,
       "",
       {},
       "File that describes it, as a jacket profile, or the name of an installed one."},
      {"feedback", "strength", &c.feedback.strength, "", Range{0.05, 1}, "How strong, of what its profile allows."},
  };
  append(rows, peer_rows(c.peer));
  append(rows, {{"peer", "heartbeat_timeout_ms", &c.heartbeat_timeout_ms, "ms", heartbeat_timeout,
                 "Without a heartbeat for so long the peer counts as absent."}});
  append(rows, common_rows(c.control, c.web, c.log));
  return rows;
}

std::vector<Key> keys_of(PassiveConfig& c) {
  Rows rows{
      {"jacket",
       "profile",
       &c.jacket.profile,
       "",
       {},
       "File that describes the jacket, or the name of an installed one (duemilanove-16.toml, "
       "duemilanove-12-heaters-2.toml, legacy-16.toml); empty: the first of these."},
      {"jacket",
       "overrides",
       &c.jacket.overrides,
       "",
       {},
       "File of the wearer's own limits, below those of the profile, and of actuators that are switched off; empty: "
       "none."},
      {"jacket", "link", &c.jacket.link, "", parsed_by(parse_jacket_link),
       "\"serial:PATH\" (take one of /dev/serial/by-id, which stays the same; \"serial:auto\": the only one there), "
       "\"rfcomm:ADDRESS\" or \"rfcomm:ADDRESS/CHANNEL\" (Bluetooth; pair it first), \"simulated\" (no jacket needed) "
       "or \"record:FILE\" (what would be sent)."},
      {"jacket", "baud", &c.jacket.baud, "baud", Range{0, 1000000},
       "Speed of the serial line; 0: as the profile says."},
      {"jacket", "several_senders", &c.jacket.several_senders, "", OneOf{{"merged", "exclusive"}},
       "What is felt when several touch at once. merged: all of them, each place as strongly as the strongest of them "
       "asks; exclusive: the one who began, until they have not touched for 2 s."},

      {"safety", "max_strength", &c.safety.max_strength, "", Range{0, 1}, "No motor is ever driven stronger."},
      {"safety", "drive_ms", &c.safety.drive_ms, "ms", Range{50, 250},
       "How long one command drives a motor; touches that last renew it."},
      {"safety", "heartbeat_timeout_ms", &c.safety.heartbeat_timeout_ms, "ms", heartbeat_timeout_of_drives,
       "Without a heartbeat for so long everything is turned off."},
      {"safety", "max_celsius", &c.safety.max_celsius, "C", Range{0, 40},
       "No heater is ever set warmer; below 32, about what skin has under clothes, none heats at all."},

      {"consent", "quiet_hours", &c.consent.quiet_hours, "", parsed_by(parse_quiet_hours),
       "When nothing is felt: local times such as \"20:30-07:00\", several with commas between them; empty: never."},
      {"consent",
       "file",
       &c.consent.file,
       "",
       {},
       "Where `telehug pause` and `telehug mute` are kept over restarts; empty: in the state folder of the service or "
       "user."},
  };
  append(rows, gpio_rows(c.gpio));
  append(rows, peer_rows(c.peer));
  append(rows, common_rows(c.control, c.web, c.log));
  return rows;
}

std::vector<Fault> impossible_combinations(const ActiveConfig& c, const std::vector<Key>& keys) {
  std::vector<Fault> faults = impossible_peers(c.peer, keys);
  if ((c.rig.screen.width_mm > 0) != (c.rig.screen.height_mm > 0)) {
    faults.push_back({place_of(keys, {"rig.screen_width_mm", "rig.screen_height_mm"}),
                      "rig.screen_width_mm and rig.screen_height_mm must both be given, or both be 0"});
  }
  if ((c.rig.screen.width_px > 0) != (c.rig.screen.height_px > 0)) {
    faults.push_back({place_of(keys, {"rig.screen_width_px", "rig.screen_height_px"}),
                      "rig.screen_width_px and rig.screen_height_px must both be given, or both be 0"});
  }
  if (c.body_map.hold_ms > c.body_map.max_age_ms) {
    faults.push_back(
        {place_of(keys, {"body_map.hold_ms", "body_map.max_age_ms"}),
         fmt::format("body_map.hold_ms ({}) must not exceed body_map.max_age_ms ({}): a held face would be refused",
                     c.body_map.hold_ms, c.body_map.max_age_ms)});
  }
  if (c.camera.power_line_hz != 0 && c.camera.power_line_hz != 50 && c.camera.power_line_hz != 60) {
    faults.push_back({place_of(keys, {"camera.power_line_hz"}), "camera.power_line_hz must be 0, 50 or 60"});
  }
  // YUYV shares the colour of two neighbouring pixels.
  if (c.camera.width_px % 2 != 0) {
    faults.push_back({place_of(keys, {"camera.width_px"}), "camera.width_px must be even"});
  }
  return faults;
}

std::vector<Fault> impossible_combinations(const PassiveConfig& c, const std::vector<Key>& keys) {
  // Speeds that termios knows and the jacket's clock can make.
  constexpr int speeds[] = {9600, 19200, 38400, 57600, 115200, 230400, 500000, 1000000};
  std::vector<Fault> faults = impossible_peers(c.peer, keys);
  if (c.jacket.baud != 0 && std::find(std::begin(speeds), std::end(speeds), c.jacket.baud) == std::end(speeds)) {
    faults.push_back(
        {place_of(keys, {"jacket.baud"}), fmt::format("jacket.baud is {}; it must be 0, or a speed that serial lines "
                                                      "know: 9600, 19200, 38400, 57600, 115200, 230400, "
                                                      "500000 or 1000000",
                                                      c.jacket.baud)});
  }
  const auto lines = impossible_lines(c.gpio, keys);
  faults.insert(faults.end(), lines.begin(), lines.end());
  return faults;
}

}  // namespace telehug
