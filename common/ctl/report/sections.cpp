// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "ctl/plain_text.hpp"
#include "ctl/report/report.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

// As written in a file, without its quotes.
std::string content(const std::string& value) {
  return value.size() >= 2 && value.front() == '"' ? value.substr(1, value.size() - 2) : value;
}

// Keys whose values begin with what kind of thing they name.
bool names_a_kind(const KeySetting& key) {
  constexpr std::array<std::string_view, 4> paths{"camera.source", "body_map.source", "jacket.link", "feedback.link"};
  return std::ranges::find(paths, key.section + "." + key.name) != paths.end();
}

std::string told_value(const KeySetting& key) {
  if (!key.free_text) return key.value;
  const std::string text = content(key.value);
  if (text.empty()) return "\"\"";
  const std::size_t end = text.find_first_of(":?");
  if (names_a_kind(key)) return end == std::string::npos ? key.value : "\"" + text.substr(0, end) + ":[...]\"";
  return fmt::format("[a text of {} letters]", text.size());
}

// Those of `object` that are named, as they are.
Json only(const Json& object, const std::vector<const char*>& names) {
  Json some = Json::object();
  if (!object.is_object()) return some;
  for (const char* name : names)
    if (object.contains(name)) some[name] = object[name];
  return some;
}

Json problems_of(const Json& status, const Masker& masker) {
  Json told = Json::array();
  for (const Json& problem : status.value("problems", Json::array())) {
    if (!problem.is_object()) continue;
    for (const char* part : {"what", "do"})
      if (problem.contains(part)) told.push_back(masker.mask_free_text(text_of(problem[part])));
  }
  return told;
}

std::string table_text(const toml::table& table, const std::vector<std::pair<const char*, const char*>>& keys) {
  std::string text;
  for (const auto& [section, key] : keys) {
    const auto node = *section == '\0' ? table[key] : table[section][key];
    if (!node) continue;
    std::string value;
    if (const auto number = node.value<double>()) value = fmt::format("{}", *number);
    if (const auto word = node.value<std::string>()) value = *word;
    text += fmt::format("{}{}{}: {}\n", section, *section == '\0' ? "" : ".", key, plain_text(value));
  }
  return text;
}

double error_of(const toml::table& touch, const char* key) {
  return touch[key].value_or(0.0);
}

}  // namespace

void hide_texts_of(const ConfigReport& report, Masker& masker) {
  for (const KeySetting& key : report.settings) {
    if (!key.free_text || key.value == key.standard) continue;
    std::string text = content(key.value);
    if (names_a_kind(key)) {
      const std::size_t colon = text.find(':');
      text = colon == std::string::npos ? "" : text.substr(colon + 1);
    }
    masker.hide(text, key.section + "." + key.name);
    // Each of a list, too: addresses, pairs.
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find(',', at), text.size());
      const std::size_t begin = std::min(text.find_first_not_of(' ', at), end);
      masker.hide(std::string_view(text).substr(begin, end - begin), key.section + "." + key.name);
      at = end + 1;
    }
  }
}

std::string config_section(const ConfigReport& report, Side side, const Masker& masker) {
  std::string text = fmt::format("{}: {} files\n", side_name(side), report.files.size());
  for (const auto& file : report.files)
    text += "  " + masker.mask(plain_text(file.string())) + "\n";
  for (const Fault& fault : report.faults)
    text += "  fault: " + masker.mask_free_text(plain_text(fault.where + ": " + fault.what)) + "\n";
  for (const KeySetting& key : report.settings)
    if (key.value != key.standard) text += fmt::format("  {}.{} = {}\n", key.section, key.name, told_value(key));
  return text;
}

void hide_texts_of(const Json& status, Masker& masker) {
  const auto hide = [&](const Json& object, const char* key, const char* word) {
    if (object.is_object() && object.contains(key) && object[key].is_string())
      masker.hide(object[key].get_ref<const std::string&>(), word);
  };
  const auto hide_peer = [&](const Json& peer) {
    hide(peer, "name", "name");
    hide(peer, "reason", "reason");
    hide(peer, "session", "id");
    const Json pair = peer.is_object() ? peer.value("pair", Json::object()) : Json::object();
    for (const auto& [key, word] : {std::pair("name", "name"), std::pair("phrase", "phrase"), std::pair("id", "id")})
      hide(pair, key, word);
  };
  if (!status.is_object()) return;
  hide(status, "session", "id");
  hide_peer({{"pair", status.value("pair", Json::object())}});
  hide_peer(status.value("peer", Json::object()));
  for (const Json& peer : status.value("peers", Json::array()))
    hide_peer(peer);
  hide(status.value("screen", Json::object()), "name", "screen");
}

std::string status_section(const Json& status, const Masker& masker) {
  if (!status.is_object()) return "";
  Json told = only(status, {"side", "version", "uptime_s", "state", "counters", "latency_ms", "detector", "local_touch",
                            "panel", "heaters", "calibrated", "link"});
  told["problems"] = problems_of(status, masker);
  for (const auto& [part, names] : {std::pair<const char*, std::vector<const char*>>(
                                        "peer", {"connected", "round_trip_ms", "one_way_ms", "stopped", "ready"}),
                                    {"camera", {"name", "open", "why", "setup"}},
                                    {"screen", {"open", "why"}},
                                    {"face", {"found", "held", "finder", "others", "pinned"}},
                                    {"sending", {"name", "on", "why"}},
                                    {"consent", {"name", "strength"}},
                                    {"jacket",
                                     {"device", "state", "firmware", "motors", "supply_v", "last_reset",
                                      "frames_it_refused", "bytes_it_lost", "heaters"}}})
    if (status.contains(part)) told[part] = only(status[part], names);
  told["connections"] = status.value("peers", Json::array()).size();
  return masker.mask(told.dump(1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

std::string calibration_section(const std::string& toml_text) {
  if (toml_text.empty()) return "none\n";
  try {
    const toml::table table = toml::parse(toml_text);
    std::string text = table_text(table, {{"", "version"},
                                          {"", "date"},
                                          {"", "model"},
                                          {"image", "width_px"},
                                          {"image", "height_px"},
                                          {"screen", "width_mm"},
                                          {"screen", "height_mm"},
                                          {"screen", "width_px"},
                                          {"screen", "height_px"},
                                          {"border", "v0_px"},
                                          {"border", "slope"},
                                          {"parameters", "focal_px"},
                                          {"parameters", "z0_mm"},
                                          {"parameters", "pitch_deg"}});
    const toml::array* touches = table["touch"].as_array();
    if (touches == nullptr) return text;
    double squares = 0;
    double worst = 0;
    for (const auto& node : *touches) {
      if (!node.is_table()) continue;
      const double error =
          std::hypot(error_of(*node.as_table(), "error_x_mm"), error_of(*node.as_table(), "error_y_mm"));
      squares += error * error;
      worst = std::max(worst, error);
    }
    const double rms = touches->empty() ? 0 : std::sqrt(squares / static_cast<double>(touches->size()));
    return text + fmt::format("touches: {}, errors: {:.2f} mm (root mean square), {:.2f} mm (greatest)\n",
                              touches->size(), rms, worst);
  } catch (const toml::parse_error& problem) {
    return fmt::format("can't be read: line {}: {}\n", problem.source().begin.line, problem.description());
  }
}

std::string jacket_section(const std::string& toml_text, bool installed, const Json& status) {
  std::string text;
  try {
    const toml::table table = toml::parse(toml_text);
    if (toml_text.empty()) text = "its profile is not there, or can't be read\n";
    text += installed ? table_text(table, {{"", "name"}}) : "a profile that is not telehug's\n";
    text += table_text(table, {{"", "version"}, {"", "link"}, {"", "baud"}, {"", "rendering"}, {"", "supply_ma"}});
    const toml::array* actuators = table["actuator"].as_array();
    text += fmt::format("actuators: {}\n", actuators == nullptr ? 0 : actuators->size());
  } catch (const toml::parse_error& problem) {
    text += fmt::format("can't be read: line {}: {}\n", problem.source().begin.line, problem.description());
  }
  const Json jacket = status.is_object() ? status.value("jacket", Json::object()) : Json::object();
  const bool told = jacket.is_object() && jacket.contains("firmware");
  return text + "firmware: " + (told ? text_of(jacket["firmware"]) : "not known, since telehug-passive does not run") +
         "\n";
}

}  // namespace telehug
