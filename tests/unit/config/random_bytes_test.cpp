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
  for (const Fault& fault : faults)
    EXPECT_FALSE(fault.what.empty());
}

TEST(ConfigFromRandomBytes, IsRefusedAndNeverEndsTheProgram) {
  std::mt19937 random(20);
  for (int round = 0; round < 3000; ++round) {
    std::string text(random() % 200, '\0');
    for (char& c : text)
      c = static_cast<char>(random());
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
    for (unsigned i = 0; i < 1 + random() % 8; ++i)
      text[random() % text.size()] = often[random() % often.size()];
    read(text);
  }
}

TEST(ConfigFromRandomBytes, MayBeNestedVeryDeeply) {
  for (const int depth : {1'900, 100'000}) {
    const auto levels = static_cast<std::size_t>(depth);
    std::string dotted = "a";
    for (std::size_t i = 0; i < levels; ++i)
      dotted += ".a";
    read("a = " + std::string(levels, '['));
    read(std::string(levels, '['));
    read(dotted + " = 1");
    read("[" + dotted + "]\n" + dotted + " = 1");
  }
}

}  // namespace
}  // namespace telehug
