// SPDX-License-Identifier: Apache-2.0
#include "jacket/load_jacket_profile.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>

#include "jacket/toml_table_reader.hpp"

namespace telehug {
namespace {

constexpr int boxes_on_a_torso = 20;     // four rows: chin to hips of a child
constexpr double farthest_place_fh = 5;  // nobody's jacket is wider or longer
constexpr double longest_duty_window_s = 600;
// Rates that a 16 MHz AVR meets within 2.1 % and that serial ports have.
constexpr std::array possible_bauds{9600, 19200, 38400, 57600, 115200, 500000, 1000000};

// What `[defaults]` may say for all motors.
struct MotorValues {
  double max_strength = 1;
  double min_strength = 0;
  double gamma = 1;
  double kick_ms = 0;
  double current_ma = 0;
  double max_duty = 1;
};

constexpr double longest_kick_ms = 100;
constexpr double most_current_ma = 1000;
constexpr double most_supply_ma = 10'000;

MotorValues read_motor_values(TomlTableReader& reader, MotorValues values) {
  const auto max = reader.number("max_strength", 0, 1);
  const auto min = reader.number("min_strength", 0, 1);
  values.max_strength = max.value_or(values.max_strength);
  values.min_strength = min.value_or(values.min_strength);
  if (values.min_strength > values.max_strength) {
    reader.fault(min ? "min_strength" : "max_strength",
                 fmt::format("leaves nothing: the least that turns, {}, is above the most allowed, {}",
                             values.min_strength, values.max_strength));
  }
  values.gamma = reader.number("gamma", 0.2, 5).value_or(values.gamma);
  values.kick_ms = reader.number("kick_ms", 0, longest_kick_ms).value_or(values.kick_ms);
  values.current_ma = reader.number("current_ma", 0, most_current_ma).value_or(values.current_ma);
  values.max_duty = reader.number("max_duty", 0.01, 1).value_or(values.max_duty);
  return values;
}

std::vector<std::uint16_t> read_boxes(TomlTableReader& reader) {
  const toml::node* node = reader.get("boxes");
  if (node == nullptr) return {};  // then it serves touches by its place only
  const toml::array* list = node->as_array();
  std::vector<std::uint16_t> boxes;
  bool sound = list != nullptr;
  for (std::size_t i = 0; sound && i < list->size(); ++i) {
    const auto box = (*list)[i].value_exact<std::int64_t>();
    sound = box && *box >= 1 && *box <= largest_box;
    if (sound) boxes.push_back(static_cast<std::uint16_t>(*box));
  }
  if (!sound) reader.fault("boxes", fmt::format("must be a list of box numbers 1..{}", largest_box));
  return boxes;
}

void read_motor(TomlTableReader& reader, const MotorValues& otherwise, Actuator& actuator) {
  reader.refuse_keys_other_than({"id", "name", "kind", "channel", "x_fh", "y_fh", "side", "boxes", "max_strength",
                                 "min_strength", "gamma", "kick_ms", "current_ma", "max_duty"});
  actuator.channel = static_cast<std::uint8_t>(reader.required_whole("channel", 0, motor_channels - 1).value_or(255));
  const MotorValues values = read_motor_values(reader, otherwise);
  actuator.max_strength = values.max_strength;
  actuator.min_strength = values.min_strength;
  actuator.gamma = values.gamma;
  actuator.kick = std::chrono::duration_cast<Duration>(std::chrono::duration<double, std::milli>(values.kick_ms));
  actuator.current_ma = values.current_ma;
  actuator.max_duty = values.max_duty;
}

void read_heater(TomlTableReader& reader, Actuator& actuator) {
  reader.refuse_keys_other_than(
      {"id", "name", "kind", "channel", "x_fh", "y_fh", "side", "boxes", "max_strength", "max_celsius"});
  actuator.channel = static_cast<std::uint8_t>(reader.required_whole("channel", 0, heater_channels - 1).value_or(255));
  actuator.max_strength = reader.number("max_strength", 0, 1).value_or(1);
  actuator.max_celsius = reader.required_number("max_celsius", least_celsius, most_celsius).value_or(least_celsius);
}

Actuator read_actuator(const toml::table& table, std::string what, const MotorValues& otherwise, TomlFaults& faults) {
  TomlTableReader reader(table, std::move(what), faults);
  Actuator actuator;
  actuator.id = static_cast<std::uint8_t>(reader.required_whole("id", 1, 255).value_or(0));
  actuator.name = reader.required_name();
  actuator.kind =
      reader.required_word("kind", {"motor", "heater"}).value_or(0) == 0 ? ActuatorKind::motor : ActuatorKind::heater;
  actuator.place.x_fh = reader.required_number("x_fh", -farthest_place_fh, farthest_place_fh).value_or(0);
  actuator.place.y_fh = reader.required_number("y_fh", -farthest_place_fh, farthest_place_fh).value_or(0);
  actuator.side = reader.required_word("side", {"front", "back"}).value_or(0) == 0 ? BodySide::front : BodySide::back;
  actuator.boxes = read_boxes(reader);
  if (actuator.kind == ActuatorKind::motor) {
    read_motor(reader, otherwise, actuator);
  } else {
    read_heater(reader, actuator);
  }
  return actuator;
}

// Appends the actuator of `table` unless its id or channel is taken already.
void append_actuator(const toml::table& table, const MotorValues& otherwise, JacketProfile& profile,
                     TomlFaults& faults) {
  const std::string what = fmt::format("actuator {}", profile.actuators.size() + 1);
  Actuator actuator = read_actuator(table, what, otherwise, faults);
  TomlTableReader reader(table, what, faults);
  for (const Actuator& other : profile.actuators) {
    if (actuator.id != 0 && other.id == actuator.id) {
      reader.fault("id", fmt::format("{} is already taken by \"{}\"", actuator.id, other.name));
    }
    if (actuator.kind == other.kind && actuator.channel < motor_channels && other.channel == actuator.channel) {
      reader.fault("channel", fmt::format("{} already drives \"{}\"", actuator.channel, other.name));
    }
  }
  profile.actuators.push_back(std::move(actuator));
}

void read_actuators(const toml::table& root, const MotorValues& otherwise, JacketProfile& profile, TomlFaults& faults) {
  const toml::node* node = root.get("actuator");
  const toml::array* list = node != nullptr ? node->as_array() : nullptr;
  if (list == nullptr || list->empty()) {
    faults.add(node != nullptr ? node->source() : root.source(),
               "the jacket has no actuators; add one [[actuator]] table for each");
    return;
  }
  for (const toml::node& entry : *list) {
    if (const toml::table* table = entry.as_table()) {
      append_actuator(*table, otherwise, profile, faults);
    } else {
      faults.add(entry.source(), "actuator must be a list of [[actuator]] tables");
    }
  }
}

MotorValues read_defaults(TomlTableReader& root, TomlFaults& faults) {
  const toml::table* table = root.table("defaults");
  if (table == nullptr) return {};
  TomlTableReader reader(*table, "defaults", faults);
  reader.refuse_keys_other_than({"max_strength", "min_strength", "gamma", "kick_ms", "current_ma", "max_duty"});
  return read_motor_values(reader, {});
}

std::vector<std::string> notes_on(const JacketProfile& profile) {
  std::vector<int> unserved;
  for (int box = 1; box <= boxes_on_a_torso; ++box) {
    const bool served = std::ranges::any_of(profile.actuators, [box](const Actuator& actuator) {
      return std::ranges::find(actuator.boxes, box) != actuator.boxes.end();
    });
    if (!served) unserved.push_back(box);
  }
  if (unserved.empty()) return {};
  return {fmt::format("no actuator serves box {}; touches there {}", fmt::join(unserved, ", "),
                      profile.uncovered == Uncovered::nearest ? "go to the nearest actuator" : "are not felt")};
}

JacketProfile read_profile(const toml::table& root, TomlFaults& faults) {
  TomlTableReader reader(root, "profile", faults);
  reader.refuse_keys_other_than({"version", "name", "baud", "protocol", "link", "uncovered", "rendering", "supply_ma",
                                 "duty_window_s", "defaults", "actuator"});
  JacketProfile profile;
  reader.required_whole("version", jacket_profile_format, jacket_profile_format);
  profile.name = reader.required_name();
  profile.baud = static_cast<int>(reader.required_whole("baud", 1, possible_bauds.back()).value_or(0));
  if (profile.baud != 0 && std::ranges::find(possible_bauds, profile.baud) == possible_bauds.end()) {
    reader.fault("baud", fmt::format("is {} but must be one of {}", profile.baud, fmt::join(possible_bauds, ", ")));
  }
  profile.protocol = reader.word("protocol", {"telehug", "legacy"}).value_or(0) == 0 ? JacketProtocol::telehug
                                                                                     : JacketProtocol::legacy;
  if (const auto wire = reader.word("link", {"serial", "bluetooth"}))
    profile.wire = *wire == 0 ? JacketWire::serial : JacketWire::bluetooth;
  profile.uncovered =
      reader.required_word("uncovered", {"nearest", "none"}).value_or(1) == 0 ? Uncovered::nearest : Uncovered::none;
  profile.rendering =
      reader.required_word("rendering", {"places", "boxes"}).value_or(1) == 0 ? Rendering::places : Rendering::boxes;
  profile.supply_ma = reader.number("supply_ma", 0, most_supply_ma).value_or(0);
  profile.duty_window = std::chrono::duration_cast<Duration>(
      std::chrono::duration<double>(reader.number("duty_window_s", 1, longest_duty_window_s).value_or(10)));
  read_actuators(root, read_defaults(reader, faults), profile, faults);
  if (profile.protocol == JacketProtocol::legacy && profile.rendering == Rendering::places)
    reader.fault("rendering", "must be \"boxes\": a legacy jacket knows no strength");
  for (const Actuator& actuator : profile.actuators) {
    if (profile.protocol == JacketProtocol::legacy && actuator.kind == ActuatorKind::heater)
      reader.fault(
          "protocol",
          fmt::format("must be \"telehug\" for the heater \"{}\": a legacy jacket can't be asked for its temperature",
                      actuator.name));
  }
  profile.notes = notes_on(profile);
  return profile;
}

}  // namespace

Result<JacketProfile> load_jacket_profile(const std::filesystem::path& path) {
  TomlFaults faults(path.string());
  JacketProfile profile;
  const auto error =
      read_toml(path, "there is no such jacket profile; name one, such as --set jacket.profile=duemilanove-16.toml",
                [&](const toml::table& root) { profile = read_profile(root, faults); });
  if (error) return *error;
  if (!faults.none()) return faults.error();
  return profile;
}

}  // namespace telehug
