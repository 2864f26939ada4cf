// SPDX-License-Identifier: Apache-2.0
#include "active_pages.hpp"

#include <utility>

#include "active_daemon.hpp"

namespace telehug {

std::span<const EmbeddedFile> active_pages();  // generated

namespace {

constexpr Duration status_interval = 250ms;

}  // namespace

DaemonPagesOptions active_pages_options(LivePicture setup_camera) {
  return {.side = Side::active,
          .commands = {"status", "stop", "resume", "send", "face", "hug", "pairing", "setup"},
          .topics = {"status", "touch", "fingers", "pairing", "setup"},
          .pictures = {{"setup.jpg", std::move(setup_camera)}},
          .files = active_pages()};
}

void ActiveDaemon::tell_pages() {
  const Timestamp now = clock_.now();
  live_touches_.forget(now);
  fingers_.follow(pages_.has_followers("fingers"), now);
  if (const auto news = fingers_.news()) pages_.tell("fingers", *news);
  if (!pages_.has_followers()) return;
  if (const auto news = live_touches_.news()) pages_.tell("touch", *news);
  if (const auto news = pairing_->news()) pages_.tell("pairing", *news);
  if (pages_.has_followers("setup")) setup_->followed();
  if (const auto news = setup_->news()) pages_.tell("setup", *news);
  if (now - told_pages_ < status_interval) return;
  told_pages_ = now;
  pages_.tell("status", status());
}

}  // namespace telehug
