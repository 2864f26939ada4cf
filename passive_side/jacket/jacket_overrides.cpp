// SPDX-License-Identifier: Apache-2.0
#include "jacket/jacket_overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "jacket/toml_table_reader.hpp"

namespace telehug {
namespace {

// Lowers `limit` to the value of `key`; a higher one is a fault.
void lower(TomlTableReader& reader, std::string_view key, double least, double& limit) {
  const auto value = reader.optional<double>(key);
  if (!value) return;
  if (*value >= least && *value <= limit) {
    limit = *value;
  } else {
    reader.fault(key,
                 fmt::format("is {} but must be {}..{}: only the profile itself can allow more", *value, least, limit));
  }
}

void override_actuator(const toml::table& table, std::size_t number, JacketProfile& profile,
                       std::set<std::uint8_t>& seen, TomlFaults& faults) {
  TomlTableReader reader(table, fmt::format("actuator {}", number), faults);
  reader.refuse_keys_other_than({"id", "enabled", "max_strength", "max_duty", "max_celsius"});
  const auto id = reader.required_whole("id", 1, 255);
  if (!id) return;
  const auto index = profile.index_of(static_cast<std::uint8_t>(*id));
  if (!index) return reader.fault("id", fmt::format("{} is none of \"{}\"", *id, profile.name));
  Actuator& actuator = profile.actuators[*index];
  if (!seen.insert(actuator.id).second) return reader.fault("id", fmt::format("{} stands here twice", *id));
  actuator.enabled = reader.optional<bool>("enabled").value_or(actuator.enabled);
  lower(reader, "max_strength", actuator.min_strength, actuator.max_strength);
  if (actuator.kind == ActuatorKind::motor) {
    lower(reader, "max_duty", 0.01, actuator.max_duty);
    if (reader.get("max_celsius") != nullptr) reader.fault("max_celsius", "is for heaters; this is a motor");
  } else {
    lower(reader, "max_celsius", least_celsius, actuator.max_celsius);
    if (reader.get("max_duty") != nullptr) reader.fault("max_duty", "is for motors; this is a heater");
  }
}

void override_all(const toml::table& root, JacketProfile& profile, TomlFaults& faults) {
  TomlTableReader reader(root, "overrides", faults);
  reader.refuse_keys_other_than({"version", "max_strength", "actuator"});
  reader.required_whole("version", jacket_profile_format, jacket_profile_format);
  if (const auto most = reader.number("max_strength", 0, 1)) {
    for (Actuator& actuator : profile.actuators) {
      actuator.max_strength = std::min(actuator.max_strength, *most);
      // What may not turn the motor is none of its strengths any more: it stays off.
      if (actuator.max_strength < actuator.min_strength) actuator.enabled = false;
    }
  }
  const toml::node* node = reader.get("actuator");
  if (node == nullptr) return;
  const toml::array* list = node->as_array();
  if (list == nullptr || !list->is_array_of_tables())
    return faults.add(node->source(), "actuator must be a list of [[actuator]] tables");
  std::set<std::uint8_t> seen;
  for (std::size_t i = 0; i < list->size(); ++i)
    override_actuator(*(*list)[i].as_table(), i + 1, profile, seen, faults);
}

void override_profile(const toml::table& root, JacketProfile& profile, TomlFaults& faults) {
  override_all(root, profile, faults);
  const auto may_run = [](const Actuator& actuator) { return actuator.enabled && actuator.max_strength > 0; };
  if (std::ranges::none_of(profile.actuators, may_run))
    faults.add(root.source(), "no actuator of the jacket is left; leave the jacket unplugged instead");
}

}  // namespace

Result<JacketProfile> with_overrides(JacketProfile profile, const std::filesystem::path& file) {
  TomlFaults faults(file.string());
  const auto error =
      read_toml(file, "there is no such file of the wearer's limits; correct jacket.overrides, or leave it empty",
                [&](const toml::table& root) { override_profile(root, profile, faults); });
  if (error) return *error;
  if (!faults.none()) return faults.error();
  for (const Actuator& actuator : profile.actuators) {
    if (!actuator.enabled)
      profile.notes.push_back(fmt::format("\"{}\" is switched off by {}", actuator.name, file.string()));
  }
  return profile;
}

}  // namespace telehug
