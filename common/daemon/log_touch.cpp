// SPDX-License-Identifier: Apache-2.0
#include "daemon/log_touch.hpp"

#include <fmt/core.h>

#include "service/log.hpp"

namespace telehug {

void log_touch(std::string_view outcome, Phase phase, std::uint32_t contact, std::uint16_t box, std::string_view peer) {
  if (phase == Phase::move || !spdlog::should_log(spdlog::level::debug)) return;
  log_about({.stage = "touch", .peer = peer, .contact = contact}, spdlog::level::debug,
            fmt::format("touch {} {} in box {}{}{}: {}", contact, phase == Phase::down ? "begins" : "ends", box,
                        peer.empty() ? "" : ", ", peer, outcome));
}

}  // namespace telehug
