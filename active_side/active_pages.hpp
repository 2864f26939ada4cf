// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "web/daemon_pages.hpp"

namespace telehug {

// What the parent's pages (web/) are made of, and what they may send and follow. Topics: "status", the status of the
// local socket, four times a second; "touch": what LiveTouches tells, whenever that changes; "fingers": what FingerFeed
// tells, in about every frame while somebody follows it.
[[nodiscard]] DaemonPagesOptions active_pages_options();

}  // namespace telehug
