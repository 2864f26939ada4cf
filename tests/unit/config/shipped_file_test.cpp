// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "config/key.hpp"
#include "config/load.hpp"
#include "config/toml_reader.hpp"

namespace telehug {
namespace {

std::string content_of(const std::string& name) {
  std::ifstream stream(std::string(TELEHUG_SOURCE) + "/deploy/config/" + name, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

// Every key as the shipped file has it, without the # that comments it out.
std::string uncommented(const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') && !line.starts_with("# ")) line.erase(0, 1);
    out += line + '\n';
  }
  return out;
}

template <typename Config>
void expect_defaults(const std::string& text) {
  Config config;
  auto keys = keys_of(config);
  Config defaults;
  const auto default_keys = keys_of(defaults);
  std::vector<Fault> faults;
  read_toml_text(uncommented(text), "shipped", keys, faults);
  for (const Fault& fault : faults)
    ADD_FAILURE() << fault.where << ": " << fault.what;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EXPECT_FALSE(keys[i].origin.empty()) << keys[i].path() << " is not in the file";
    EXPECT_EQ(toml_text(keys[i].target), toml_text(default_keys[i].target)) << keys[i].path();
    EXPECT_FALSE(keys[i].help.empty()) << keys[i].path();
  }
  EXPECT_TRUE(impossible_combinations(config, keys).empty());
}

// If this fails: cmake --build --preset release --target config_files
TEST(ShippedConfigFile, SaysWhatTheTableSays) {
  EXPECT_EQ(content_of("active.toml"), shipped_config_file(Side::active));
  EXPECT_EQ(content_of("passive.toml"), shipped_config_file(Side::passive));
}

TEST(ShippedConfigFile, HoldsEveryKeyAtItsDefault) {
  expect_defaults<ActiveConfig>(content_of("active.toml"));
  expect_defaults<PassiveConfig>(content_of("passive.toml"));
}

TEST(ShippedConfigFile, ChangesNothingAsItIs) {
  ConfigSources sources;
  sources.only_file = std::string(TELEHUG_SOURCE) + "/deploy/config/active.toml";
  EXPECT_TRUE(load_active_config(sources));
}

}  // namespace
}  // namespace telehug
