// SPDX-License-Identifier: Apache-2.0
#include "ctl/status_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "ctl/plain_text.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

const Json* part(const Json& json, const std::string& name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  return json.is_object() && found != json.end() ? &*found : nullptr;
}

std::string text_at(const Json& json, const std::string& name) {
  const Json* value = part(json, name);
  return value == nullptr ? "" : text_of(*value);
}

bool flag_at(const Json& json, const std::string& name) {
  const Json* value = part(json, name);
  return value != nullptr && value->is_boolean() && value->get<bool>();
}

bool says_something(const Json& value) {
  return !value.is_null() && !(value.is_string() && value.get_ref<const std::string&>().empty()) &&
         !(value.is_structured() && value.empty());
}

// "name value, name value" of what is left of a part.
std::string rest_of(const Json& json, std::initializer_list<std::string_view> shown) {
  std::string text;
  for (const auto& [name, value] : json.items()) {
    if (!says_something(value) || std::find(shown.begin(), shown.end(), name) != shown.end()) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", plain_text(name), text_of(value));
  }
  return text;
}

std::string joined(const std::string& left, const std::string& separator, const std::string& right) {
  if (left.empty() || right.empty()) return left + right;
  return left + separator + right;
}

std::string line(std::string_view label, const std::string& text) {
  return fmt::format("  {:<12} {}\n", label, text);
}

std::string uptime_text(const Json& status) {
  const Json* value = part(status, "uptime_s");
  if (value == nullptr || !value->is_number()) return "";
  const auto seconds = static_cast<long long>(std::clamp(value->get<double>(), 0.0, 1e12));
  if (seconds < 120) return fmt::format("up {} s", seconds);
  if (seconds < 7200) return fmt::format("up {} min", seconds / 60);
  return fmt::format("up {} h {} min", seconds / 3600, seconds / 60 % 60);
}

std::string heading(const Json& status) {
  const std::string side = text_at(status, "side");
  std::string text = side.empty() ? "daemon" : side + " side";
  text = joined(text, ": ", text_at(status, "state"));
  std::string about = joined(text_at(status, "version"), ", ", uptime_text(status));
  if (!about.empty()) text += " (" + about + ")";
  return text + '\n';
}

std::string problems_text(const Json& problems) {
  if (!problems.is_array()) return line("problems", text_of(problems));
  std::string text;
  for (const Json& problem : problems) {
    const std::string what = problem.is_object() ? text_at(problem, "what") : text_of(problem);
    text += line("problem", what);
    if (const std::string to_do = text_at(problem, "do"); !to_do.empty()) text += line("", "-> " + to_do);
  }
  return text;
}

// How a peer is; after its name if it is one of several.
std::string peer_text(const Json& peer) {
  if (!peer.is_object()) return line("peer", text_of(peer));
  std::string text = flag_at(peer, "connected") ? "connected" : "not connected";
  if (flag_at(peer, "stopped")) text += ", stopped";
  text = joined(text, ": ", text_at(peer, "reason"));
  if (const std::string ms = text_at(peer, "round_trip_ms"); !ms.empty()) text += fmt::format(", round trip {} ms", ms);
  if (const std::string ms = text_at(peer, "one_way_ms"); !ms.empty()) text += fmt::format(", to here {} ms", ms);
  return line("peer", joined(text_at(peer, "name"), ": ",
                             joined(text, ", ",
                                    rest_of(peer, {"connected", "stopped", "reason", "round_trip_ms", "one_way_ms",
                                                   "name", "pair", "link", "session"}))));
}

// "peers" tells of all of them, "peer", "pair" and "link" of one of them.
std::string peers_text(const Json& status) {
  std::string text;
  const Json* peers = part(status, "peers");
  if (peers != nullptr && peers->is_array()) {
    for (const Json& peer : *peers)
      text += peer_text(peer);
  } else if (const Json* peer = part(status, "peer")) {
    text += peer_text(*peer);
  }
  return text;
}

// Camera, screen and others that are open, closed, or neither; a touch begins with what it is. Places are for programs.
std::string thing_text(std::string_view label, const Json& thing) {
  if (!thing.is_object()) return line(label, text_of(thing));
  std::string text = joined(text_at(thing, "name"), ", ", text_at(thing, "gesture"));
  if (part(thing, "open") != nullptr) text = joined(text, ", ", flag_at(thing, "open") ? "open" : "closed");
  text = joined(text, ": ", text_at(thing, "why"));
  return line(label, joined(text, ", ",
                            rest_of(thing, {"name", "gesture", "open", "why", "places_px", "reach_mm", "heaters"})));
}

// One line for each of several.
std::string things_text(std::string_view label, const Json& things) {
  const auto is_object = [](const Json& thing) { return thing.is_object(); };
  if (!things.is_array() || things.empty() || !std::all_of(things.begin(), things.end(), is_object)) {
    return thing_text(label, things);
  }
  std::string text;
  for (const Json& thing : things)
    text += thing_text(label, thing);
  return text;
}

// One line: "left: 33.4 C, set-point 36.0 C", or why it is off.
std::string heater_text(const Json& heater) {
  const auto celsius = [&heater](const char* name) {
    const Json* value = part(heater, name);
    return value != nullptr && value->is_number() ? fmt::format("{:.1f} C", value->get<double>()) : "";
  };
  const Json* set_point = part(heater, "set_point_celsius");
  const bool heats = set_point != nullptr && set_point->is_number() && set_point->get<double>() > 0;
  const std::string what =
      heats ? "set-point " + celsius("set_point_celsius") : joined("off", ": ", text_at(heater, "why"));
  const std::string is = celsius("celsius");
  return line("heater", joined(text_at(heater, "name"), ": ", (is.empty() ? "no reading" : is) + ", " + what));
}

std::string heaters_text(const Json& heaters) {
  std::string text;
  for (const Json& heater : heaters.is_array() ? heaters : Json::array())
    text += heater_text(heater);
  return text;
}

// Of motors that have used up a hundredth of their budget or more.
std::string duty_text(const Json& duty) {
  std::string text;
  for (const Json& motor : duty.is_array() ? duty : Json::array()) {
    const Json* used = part(motor, "used");
    if (used == nullptr || !used->is_number() || used->get<double>() < 0.01) continue;
    text = joined(text, ", ", fmt::format("motor {} {:.0f} %", text_at(motor, "id"), used->get<double>() * 100));
  }
  return text.empty() ? "" : line("duty used", text);
}

std::string counters_text(const Json& counters) {
  if (!counters.is_object() || counters.empty()) return "";
  std::string text = "  counters\n";
  for (const auto& [name, value] : counters.items()) {
    text += fmt::format("    {:<36} {:>12}\n", plain_text(name), text_of(value));
  }
  return text;
}

std::string number_text(const Json& stage, const std::string& name) {
  const Json* value = part(stage, name);
  if (value == nullptr) return "-";
  return value->is_number_float() ? fmt::format("{:.3f}", value->get<double>()) : text_of(*value);
}

std::string latencies_text(const Json& stages) {
  if (!stages.is_object() || stages.empty()) return "";
  std::string text = fmt::format("  {:<38} {:>9} {:>9} {:>9} {:>9}\n", "latency, ms", "p50", "p99", "max", "count");
  for (const auto& [name, stage] : stages.items()) {
    text += fmt::format("    {:<36} {:>9} {:>9} {:>9} {:>9}\n", plain_text(name), number_text(stage, "p50"),
                        number_text(stage, "p99"), number_text(stage, "max"), number_text(stage, "count"));
  }
  return text;
}

}  // namespace

std::string status_text(const Json& status) {
  static constexpr std::array<const char*, 8> things{"camera",  "screen", "face",       "sending",
                                                     "consent", "jacket", "last_touch", "last_hug"};
  static constexpr std::array<const char*, 11> placed{"side",  "version", "uptime_s", "state",    "problems",  "peer",
                                                      "peers", "heaters", "duty",     "counters", "latency_ms"};
  std::string text = heading(status);
  if (const Json* problems = part(status, "problems")) text += problems_text(*problems);
  text += peers_text(status);
  for (const char* name : things) {
    std::string label = name;
    std::replace(label.begin(), label.end(), '_', ' ');
    if (const Json* thing = part(status, name)) text += thing_text(label, *thing);
  }
  if (const Json* heaters = part(status, "heaters")) text += heaters_text(*heaters);
  if (const Json* duty = part(status, "duty")) text += duty_text(*duty);
  if (status.is_object()) {
    for (const auto& [name, value] : status.items()) {
      const auto is = [&key = name](const char* known) { return key == known; };
      const bool of_one_of_several = status.contains("peers") && (is("pair") || is("link"));
      if (of_one_of_several || std::any_of(things.begin(), things.end(), is) ||
          std::any_of(placed.begin(), placed.end(), is)) {
        continue;
      }
      text += things_text(plain_text(name), value);
    }
  }
  if (const Json* counters = part(status, "counters")) text += counters_text(*counters);
  if (const Json* stages = part(status, "latency_ms")) text += latencies_text(*stages);
  return text;
}

}  // namespace telehug
