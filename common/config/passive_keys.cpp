// SPDX-License-Identifier: Apache-2.0
//
// After a change here: cmake --build --preset release --target config_files
#include <fmt/core.h>

#include <algorithm>

#include "config/key_rows.hpp"
#include "config/locator.hpp"
#include "config/quiet_hours_text.hpp"

namespace telehug {
namespace {

// A heartbeat comes every 100 ms. What drives a motor trusts a silent sender for at most as long as one command of the
// jacket lasts.
constexpr Range heartbeat_timeout_of_drives{150, 250};

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
