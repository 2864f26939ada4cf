// SPDX-License-Identifier: Apache-2.0
#include "consent_file.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <system_error>

#include "common/outside_json.hpp"
#include "config/quiet_hours_text.hpp"
#include "files/private_file.hpp"
#include "files/text_file.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr int format = 1;
constexpr std::int64_t last_second = 253402300799;  // of the year 9999

const Error damaged{"is damaged: it is none that this version of telehug has written"};

template <std::size_t size>
Json numbers_in(const std::bitset<size>& set) {
  Json list = Json::array();
  for (std::size_t number = 0; number < size; ++number)
    if (set.test(number)) list.push_back(number);
  return list;
}

// Nothing if it is no list of numbers from 1 to size - 1.
template <std::size_t size>
std::optional<std::bitset<size>> set_of(const Json& list) {
  if (!list.is_array()) return std::nullopt;
  std::bitset<size> set;
  for (const Json& number : list) {
    if (!number.is_number_unsigned()) return std::nullopt;
    const auto value = number.get<std::uint64_t>();
    if (value == 0 || value >= size) return std::nullopt;
    set.set(static_cast<std::size_t>(value));
  }
  return set;
}

// false, true, or the second in UTC at which the pause ends. The outer one is empty if it is none of these.
std::optional<std::optional<Pause>> pause_in(const Json& json) {
  if (json.is_boolean()) return json.get<bool>() ? std::optional(Pause{}) : std::optional<Pause>{};
  if (!json.is_number_unsigned()) return std::nullopt;
  const auto second = json.get<std::uint64_t>();
  if (second > last_second) return std::nullopt;
  return Pause{std::chrono::sys_seconds(std::chrono::seconds(second))};
}

std::optional<double> strength_in(const Json& json) {
  if (!json.is_number()) return std::nullopt;
  const auto strength = json.get<double>();
  return strength > 0 && strength <= 1 ? std::optional(strength) : std::nullopt;
}

std::optional<QuietHours> quiet_hours_in(const Json& json) {
  if (!json.is_string()) return std::nullopt;
  const auto hours = parse_quiet_hours(json.get<std::string>());
  return hours ? std::optional(*hours) : std::nullopt;
}

Json pause_json(const std::optional<Pause>& pause) {
  if (!pause || !pause->until) return pause.has_value();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, pause->until->time_since_epoch().count()));
}

}  // namespace

Result<Consent> parse_consent(std::string_view text) {
  const Json json = parse_outside_json(text);
  // Versions before these two wrote none.
  const std::size_t newer = json.count("strength") + json.count("quiet_hours");
  if (!json.is_object() || json.size() != 4 + newer) return damaged;
  for (const char* key : {"format", "paused", "muted_boxes", "muted_actuators"})
    if (!json.contains(key)) return damaged;
  if (json.at("format") != format) return damaged;
  const auto pause = pause_in(json.at("paused"));
  const auto boxes = set_of<largest_box + 1>(json.at("muted_boxes"));
  const auto actuators = set_of<256>(json.at("muted_actuators"));
  const auto strength = strength_in(json.value("strength", Json(1.0)));
  const auto hours = quiet_hours_in(json.value("quiet_hours", Json("")));
  if (!pause || !boxes || !actuators || !strength || !hours) return damaged;
  Consent consent;
  consent.pause = *pause;
  consent.muted_boxes = *boxes;
  consent.muted_actuators = *actuators;
  consent.strength = *strength;
  consent.own_quiet_hours = *hours;
  return consent;
}

Result<Consent> read_consent(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::status(file, ignored).type() == std::filesystem::file_type::not_found) return Consent{};
  const auto text = read_text_file(file);
  if (!text) return text.error();
  return parse_consent(*text);
}

Status keep_consent(const std::filesystem::path& file, const Consent& consent) {
  std::error_code ignored;  // writing says what is wrong
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
  const Json json{{"format", format},
                  {"paused", pause_json(consent.pause)},
                  {"muted_boxes", numbers_in(consent.muted_boxes)},
                  {"muted_actuators", numbers_in(consent.muted_actuators)},
                  {"strength", consent.strength},
                  {"quiet_hours", quiet_hours_text(consent.own_quiet_hours)}};
  return keep_private_file(file, json.dump() + "\n");
}

}  // namespace telehug
