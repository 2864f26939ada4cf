// SPDX-License-Identifier: Apache-2.0
//
// Prints the configuration file that is shipped for a side: telehug_config_file active|passive
#include <cstdio>
#include <string_view>

#include "config/load.hpp"

int main(int argc, char** argv) {
  const std::string_view side = argc == 2 ? argv[1] : "";
  if (side != "active" && side != "passive") {
    std::fputs("usage: telehug_config_file active|passive\n", stderr);
    return 2;
  }
  const auto text = telehug::shipped_config_file(side == "active" ? telehug::Side::active : telehug::Side::passive);
  return std::fputs(text.c_str(), stdout) < 0 ? 1 : 0;
}
