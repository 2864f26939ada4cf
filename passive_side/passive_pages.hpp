// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "web/daemon_pages.hpp"

namespace telehug {

// What the wearer's pages (web/) are made of, and what they may send and follow. Topics: "status", the status of the
// local socket, four times a second; "running": {"actuators": [ids]}, whenever that changes.
[[nodiscard]] DaemonPagesOptions passive_pages_options();

}  // namespace telehug
