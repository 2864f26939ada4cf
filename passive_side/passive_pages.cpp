// SPDX-License-Identifier: Apache-2.0
#include "passive_pages.hpp"

#include "passive_daemon.hpp"

namespace telehug {

std::span<const EmbeddedFile> passive_pages();  // generated

namespace {

constexpr Duration status_interval = 250ms;

nlohmann::json running_json(const std::set<std::uint8_t>& actuators) {
  return {{"actuators", actuators}};
}

}  // namespace

DaemonPagesOptions passive_pages_options() {
  return {.side = Side::passive,
          .commands = {"status", "stop", "resume", "pause", "unpause", "mute", "unmute", "strength", "quiet", "jacket",
                       "jacket_trial", "hug", "pairing"},
          .topics = {"status", "running", "pairing"},
          .files = passive_pages()};
}

// To the watchers every change; to the pages, which only see the last one, all that ran since the one before.
void PassiveDaemon::tell_running_to_all() {
  std::optional<std::set<std::uint8_t>> ran;
  RunningChange change;
  while (running_.pop(change)) {
    if (!ran) ran = std::exchange(runs_, {});
    runs_ = {change.actuators.begin(), change.actuators.end()};
    ran->insert(runs_.begin(), runs_.end());
    control_->broadcast({{"event", "running"}, {"side", "passive"}, {"time_ns", change.time_ns}, {"actuators", runs_}});
  }
  if (ran) {
    pages_.tell("running", running_json(*ran));
    running_told_ = *ran;
  } else if (running_told_ != runs_) {
    pages_.tell("running", running_json(runs_));
    running_told_ = runs_;
  }
}

void PassiveDaemon::tell_pages() {
  const Timestamp now = clock_.now();
  if (!pages_.has_followers()) return;
  if (const auto news = pairing_->news()) pages_.tell("pairing", *news);
  if (now - told_pages_ < status_interval) return;
  told_pages_ = now;
  pages_.tell("status", status());
}

}  // namespace telehug
