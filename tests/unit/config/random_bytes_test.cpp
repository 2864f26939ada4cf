// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "config/load.hpp"
#include "config/toml_reader.hpp"

namespace telehug {
namespace {

void read(const std::string& text) {
  ActiveConfig config;
  auto keys = keys_of(config);
  std::vector<Fault> faults;
  read_toml_text(text, "random", keys, faults);
  for (const Fault& fault : faults) EXPECT_FALSE(fault.what.empty());
}

TEST(ConfigFromRandomBytes, IsRefusedAndNeverEndsTheProgram) {
  std::mt19937 random(20);
  for (int round = 0; round < 3000; ++round) {
    std::string text(random() % 200, '\0');
    for (char& c : text) c = static_cast<char>(random());
    read(text);
  }
}

TEST(ConfigFromRandomBytes, MayLookAlmostLikeARealFile) {
  const std::string real = shipped_config_file(Side::active);
  const std::string often = "[]{}\"'=.#\n\\,0-";
  std::mt19937 random(21);
  for (int round = 0; round < 1000; ++round) {
    std::string text = real;
    std::erase(text, '#');
    for (unsigned i = 0; i < 1 + random() % 8; ++i) text[random() % text.size()] = often[random() % often.size()];
    read(text);
  }
}

TEST(ConfigFromRandomBytes, MayBeNestedVeryDeeply) {
  read("a = " + std::string(100'000, '['));
  read(std::string(100'000, '['));
  std::string dotted = "a";
  for (int i = 0; i < 50'000; ++i) dotted += ".a";
  read(dotted + " = 1");
}

}  // namespace
}  // namespace telehug
