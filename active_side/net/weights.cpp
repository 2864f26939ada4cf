// SPDX-License-Identifier: Apache-2.0
#include "net/weights.hpp"

// The assembler takes the files in; C++20 has no #embed.
#define TELEHUG_EMBED(symbol, file)                \
  asm(".section .rodata\n"                         \
      ".global " #symbol "\n" #symbol              \
      ":\n"                                        \
      ".incbin \"" TELEHUG_WEIGHTS_FOLDER "/" file \
      "\"\n"                                       \
      ".global " #symbol "_end\n" #symbol          \
      "_end:\n"                                    \
      ".byte 0\n"                                  \
      ".previous\n")

TELEHUG_EMBED(telehug_overview_net, "overview.net");
TELEHUG_EMBED(telehug_tip_net, "tip.net");

extern "C" {
extern const char telehug_overview_net[];
extern const char telehug_overview_net_end[];
extern const char telehug_tip_net[];
extern const char telehug_tip_net_end[];
}

namespace telehug {

std::string_view overview_weights() {
  return {telehug_overview_net, telehug_overview_net_end};
}

std::string_view tip_weights() {
  return {telehug_tip_net, telehug_tip_net_end};
}

}  // namespace telehug
