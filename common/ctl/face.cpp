// SPDX-License-Identifier: Apache-2.0
#include "ctl/active_order.hpp"
#include "ctl/command.hpp"

namespace telehug {

void add_face(CLI::App& app, ExitCode& result) {
  add_active_order(app, result,
                   {.command = "face",
                    .about = "Choose the remote person among the faces on the screen",
                    .field = "order",
                    .words = {"next", "pin", "unpin"},
                    .meanings = "next: follow the next face to the right; pin: stay with this face and its place; "
                                "unpin: no longer"});
}

}  // namespace telehug
