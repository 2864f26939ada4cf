// SPDX-License-Identifier: Apache-2.0
#include "ctl/config_text.hpp"

#include <fmt/core.h>

#include "ctl/plain_text.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

bool differs(const KeySetting& key) {
  return key.value != key.standard;
}

std::string from(const KeySetting& key) {
  return key.origin.empty() ? "default" : plain_text(key.origin);
}

}  // namespace

std::string config_check_text(const ConfigReport& report, Side side) {
  std::string text;
  for (const Fault& fault : report.faults)
    text += fmt::format("{}: {}\n", plain_text(fault.where.empty() ? side_name(side) : fault.where),
                        plain_text(fault.what));
  if (!text.empty()) return text;
  std::string files;
  for (const auto& file : report.files)
    files += fmt::format("{}{}", files.empty() ? "" : ", ", plain_text(file.string()));
  return fmt::format("{}: no fault in {}\n", side_name(side), files.empty() ? "the defaults; there is no file" : files);
}

std::string config_show_text(const ConfigReport& report, Side side) {
  std::string text = fmt::format("# {} side\n", side_name(side));
  std::string section;
  for (const KeySetting& key : report.settings) {
    if (key.section != section) text += fmt::format("\n[{}]\n", key.section);
    section = key.section;
    text += fmt::format("{:<40} # {}\n", fmt::format("{} = {}", key.name, key.value), from(key));
  }
  return text;
}

std::string config_diff_text(const ConfigReport& report, Side side) {
  std::string text;
  for (const KeySetting& key : report.settings) {
    if (!differs(key)) continue;
    text += fmt::format("{}: {}.{} = {} (default {}), {}\n", side_name(side), key.section, key.name, key.value,
                        key.standard, from(key));
  }
  return text.empty() ? fmt::format("{}: all at their defaults\n", side_name(side)) : text;
}

nlohmann::json config_json(const ConfigReport& report, Side side) {
  nlohmann::json json{{"side", side_name(side)}};
  json["files"] = nlohmann::json::array();
  for (const auto& file : report.files)
    json["files"].push_back(file.string());
  json["faults"] = nlohmann::json::array();
  for (const Fault& fault : report.faults)
    json["faults"].push_back({{"where", fault.where}, {"what", fault.what}});
  for (const KeySetting& key : report.settings) {
    json["keys"][fmt::format("{}.{}", key.section, key.name)] = {
        {"value", key.value}, {"default", key.standard}, {"from", from(key)}};
  }
  return json;
}

}  // namespace telehug
