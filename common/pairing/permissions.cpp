// SPDX-License-Identifier: Apache-2.0
#include "pairing/permissions.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <initializer_list>

namespace telehug {
namespace {

std::string xml_time(WallTime time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string topics(const char* writer, std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names)
    text += fmt::format("            <topic>telehug/v1/{}/{}</topic>\n", writer, name);
  return text;
}

std::string criteria(const char* kind, const std::string& topics, const std::string& partition) {
  return fmt::format(
      "        <{0}>\n          <topics>\n{1}          </topics>\n          <partitions>\n"
      "            <partition>{2}</partition>\n          </partitions>\n        </{0}>\n",
      kind, topics, partition);
}

}  // namespace

std::string governance() {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <domain_access_rules>
    <domain_rule>
      <domains>
        <id_range>
          <min>0</min>
          <max>100</max>
        </id_range>
      </domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>ENCRYPT</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>NONE</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)";
}

std::string permissions(Side side, const std::string& subject, const std::string& partition, const Validity& validity) {
  const std::string of_active = topics("active", {"touch", "heartbeat", "status", "stop"});
  const std::string of_passive = topics("passive", {"felt", "heartbeat", "status", "stop"});
  const bool active = side == Side::active;
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <permissions>
    <grant name="{}">
      <subject_name>{}</subject_name>
      <validity>
        <not_before>{}</not_before>
        <not_after>{}</not_after>
      </validity>
      <allow_rule>
        <domains>
          <id_range>
            <min>0</min>
            <max>100</max>
          </id_range>
        </domains>
{}{}      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)",
                     active ? "parent" : "wearer", subject, xml_time(validity.from), xml_time(validity.until),
                     criteria("publish", active ? of_active : of_passive, partition),
                     criteria("subscribe", active ? of_passive : of_active, partition));
}

}  // namespace telehug
