// SPDX-License-Identifier: Apache-2.0
#include "jacket/load_jacket_profile.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <string_view>

#include "files/text_file.hpp"

namespace telehug {
namespace {

constexpr int boxes_on_a_torso = 20;     // four rows: chin to hips of a child
constexpr double farthest_place_fh = 5;  // nobody's jacket is wider or longer
// Rates that a 16 MHz AVR meets within 2.1 % and that serial ports have.
constexpr std::array possible_bauds{9600, 19200, 38400, 57600, 115200, 500000, 1000000};

template <typename T>
constexpr std::string_view type_name() {
  if (std::is_same_v<T, std::int64_t>) return "a whole number";
  return std::is_same_v<T, double> ? "a number" : "a text in quotes";
}

// Collects every fault of a file with its line.
class Faults {
 public:
  explicit Faults(std::string file) : file_(std::move(file)) {}

  void add(const toml::source_region& where, std::string_view sentence) {
    lines_.emplace(where.begin.line, fmt::format("{}:{}: {}", file_, where.begin.line, sentence));
  }
  [[nodiscard]] bool none() const { return lines_.empty(); }
  // In the order of lines; those of one line in the order in which they were found.
  [[nodiscard]] Error error() const {
    std::string text;
    for (const auto& [line, sentence] : lines_)
      text += (text.empty() ? "" : "\n") + sentence;
    return {text};
  }

 private:
  std::string file_;
  std::multimap<toml::source_index, std::string> lines_;
};

// Reads one table; says which of its keys are missing, wrong or unknown.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string what, Faults& faults)
      : table_(table), what_(std::move(what)), faults_(faults) {}

  template <typename T>
  std::optional<T> optional(std::string_view key) {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    if constexpr (std::is_same_v<T, double>) {
      if (node->is_number()) return node->value<double>();
    } else {
      if (const auto value = node->value_exact<T>()) return value;
    }
    fault(key, fmt::format("must be {}", type_name<T>()));
    return std::nullopt;
  }

  template <typename T>
  std::optional<T> required(std::string_view key) {
    if (table_.contains(key)) return optional<T>(key);
    faults_.add(table_.source(), fmt::format("{} has no {}; add it", what_, key));
    return std::nullopt;
  }

  std::optional<std::int64_t> required_whole(std::string_view key, std::int64_t least, std::int64_t most) {
    const auto value = required<std::int64_t>(key);
    if (!value || (*value >= least && *value <= most)) return value;
    fault(key, fmt::format("is {} but must be {}..{}", *value, least, most));
    return std::nullopt;
  }

  // `value` as read; a fault if it is not finite or out of range.
  std::optional<double> in_range(std::string_view key, std::optional<double> value, double least, double most) {
    if (!value || (std::isfinite(*value) && *value >= least && *value <= most)) return value;
    fault(key, fmt::format("is {} but must be {}..{}", *value, least, most));
    return std::nullopt;
  }

  // One of `words`; its index.
  std::optional<std::size_t> required_word(std::string_view key, std::initializer_list<std::string_view> words) {
    const auto value = required<std::string>(key);
    if (!value) return std::nullopt;
    const auto* found = std::ranges::find(words, *value);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    fault(key, fmt::format("is \"{}\" but must be \"{}\"", *value, fmt::join(words, "\" or \"")));
    return std::nullopt;
  }

  std::string required_name() {
    const auto name = required<std::string>("name");
    if (name && name->empty()) fault("name", "is empty; a person reads it");
    return name.value_or("");
  }

  void refuse_keys_other_than(std::initializer_list<std::string_view> known) {
    for (const auto& [key, node] : table_) {
      if (std::ranges::find(known, key.str()) != known.end()) continue;
      faults_.add(key.source(),
                  fmt::format("{}: unknown key {}; known are {}", what_, key.str(), fmt::join(known, ", ")));
    }
  }

  void fault(std::string_view key, std::string_view sentence) {
    const toml::node* node = table_.get(key);
    faults_.add(node != nullptr ? node->source() : table_.source(), fmt::format("{}: {} {}", what_, key, sentence));
  }

  [[nodiscard]] const toml::node* get(std::string_view key) const { return table_.get(key); }

 private:
  const toml::table& table_;
  std::string what_;
  Faults& faults_;
};

struct Strengths {
  double max = 1;
  double min = 0;
};

Strengths read_strengths(TableReader& reader, Strengths otherwise) {
  const auto max = reader.in_range("max_strength", reader.optional<double>("max_strength"), 0, 1);
  const auto min = reader.in_range("min_strength", reader.optional<double>("min_strength"), 0, 1);
  const Strengths read{max.value_or(otherwise.max), min.value_or(otherwise.min)};
  if (read.min > read.max) {
    reader.fault(
        min ? "min_strength" : "max_strength",
        fmt::format("leaves nothing: the least that turns, {}, is above the most allowed, {}", read.min, read.max));
  }
  return read;
}

std::vector<std::uint16_t> read_boxes(TableReader& reader) {
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

Actuator read_actuator(const toml::table& table, std::string what, Strengths otherwise, Faults& faults) {
  TableReader reader(table, std::move(what), faults);
  reader.refuse_keys_other_than(
      {"id", "name", "kind", "channel", "x_fh", "y_fh", "side", "boxes", "max_strength", "min_strength"});
  Actuator actuator;
  actuator.id = static_cast<std::uint8_t>(reader.required_whole("id", 1, 255).value_or(0));
  actuator.name = reader.required_name();
  reader.required_word("kind", {"motor"});
  actuator.channel = static_cast<std::uint8_t>(reader.required_whole("channel", 0, motor_channels - 1).value_or(255));
  actuator.place.x_fh =
      reader.in_range("x_fh", reader.required<double>("x_fh"), -farthest_place_fh, farthest_place_fh).value_or(0);
  actuator.place.y_fh =
      reader.in_range("y_fh", reader.required<double>("y_fh"), -farthest_place_fh, farthest_place_fh).value_or(0);
  actuator.side = reader.required_word("side", {"front", "back"}).value_or(0) == 0 ? BodySide::front : BodySide::back;
  actuator.boxes = read_boxes(reader);
  const Strengths strengths = read_strengths(reader, otherwise);
  actuator.max_strength = strengths.max;
  actuator.min_strength = strengths.min;
  return actuator;
}

// Appends the actuator of `table` unless its id or channel is taken already.
void append_actuator(const toml::table& table, Strengths otherwise, JacketProfile& profile, Faults& faults) {
  const std::string what = fmt::format("actuator {}", profile.actuators.size() + 1);
  Actuator actuator = read_actuator(table, what, otherwise, faults);
  TableReader reader(table, what, faults);
  for (const Actuator& other : profile.actuators) {
    if (actuator.id != 0 && other.id == actuator.id) {
      reader.fault("id", fmt::format("{} is already taken by \"{}\"", actuator.id, other.name));
    }
    if (actuator.channel < motor_channels && other.channel == actuator.channel) {
      reader.fault("channel", fmt::format("{} already drives \"{}\"", actuator.channel, other.name));
    }
  }
  profile.actuators.push_back(std::move(actuator));
}

void read_actuators(const toml::table& root, Strengths otherwise, JacketProfile& profile, Faults& faults) {
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

Strengths read_defaults(const toml::table& root, Faults& faults) {
  const toml::node* node = root.get("defaults");
  if (node == nullptr) return {};
  const toml::table* table = node->as_table();
  if (table == nullptr) {
    faults.add(node->source(), "defaults must be a table: [defaults]");
    return {};
  }
  TableReader reader(*table, "defaults", faults);
  reader.refuse_keys_other_than({"max_strength", "min_strength"});
  return read_strengths(reader, {});
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

Result<JacketProfile> read_profile(const toml::table& root, const std::string& file) {
  Faults faults(file);
  TableReader reader(root, "profile", faults);
  reader.refuse_keys_other_than({"version", "name", "baud", "uncovered", "defaults", "actuator"});
  JacketProfile profile;
  reader.required_whole("version", jacket_profile_format, jacket_profile_format);
  profile.name = reader.required_name();
  profile.baud = static_cast<int>(reader.required_whole("baud", 1, possible_bauds.back()).value_or(0));
  if (profile.baud != 0 && std::ranges::find(possible_bauds, profile.baud) == possible_bauds.end()) {
    reader.fault("baud", fmt::format("is {} but must be one of {}", profile.baud, fmt::join(possible_bauds, ", ")));
  }
  profile.uncovered =
      reader.required_word("uncovered", {"nearest", "none"}).value_or(1) == 0 ? Uncovered::nearest : Uncovered::none;
  read_actuators(root, read_defaults(root, faults), profile, faults);
  if (!faults.none()) return faults.error();
  profile.notes = notes_on(profile);
  return profile;
}

}  // namespace

Result<JacketProfile> load_jacket_profile(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    return Error{fmt::format("{}: there is no such jacket profile; see deploy/jackets for the shipped ones", file)};
  }
  try {
    const auto text = read_text_file(path);
    if (!text) return Error{fmt::format("{}: {}", file, text.error().message)};
    return read_profile(toml::parse(*text, file), file);
  } catch (const toml::parse_error& error) {
    return Error{fmt::format("{}:{}: not valid TOML: {}", file, error.source().begin.line, error.description())};
  }
}

}  // namespace telehug
