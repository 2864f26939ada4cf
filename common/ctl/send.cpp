// SPDX-License-Identifier: Apache-2.0
#include "ctl/active_order.hpp"
#include "ctl/command.hpp"

namespace telehug {

void add_send(CLI::App& app, ExitCode& result) {
  add_active_order(app, result,
                   {.command = "send",
                    .about = "Do touches on the screen go out to the other side?",
                    .field = "mode",
                    .words = {"on", "off", "auto", "toggle"},
                    .meanings = "on; off; auto: only while the pinned window is in front; toggle: off, or as before"});
}

}  // namespace telehug
