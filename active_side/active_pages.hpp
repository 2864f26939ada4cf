// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "web/daemon_pages.hpp"

namespace telehug {

// What the parent's pages (web/) are made of, and what they may send and follow. Topics: "status", the status of the
// local socket, four times a second; "touch", "pairing", "setup": what LiveTouches, PairingDesk and SetupDesk tell,
// whenever that changes; "fingers": what FingerFeed tells, in about every frame while somebody follows it.
// `setup_camera`: what the camera of a set-up sees.
[[nodiscard]] DaemonPagesOptions active_pages_options(LivePicture setup_camera);

}  // namespace telehug
