// SPDX-License-Identifier: Apache-2.0
//
// Hugs in so many words: the one that goes out without the screen being touched, and the wearer's answer.
#include <fmt/core.h>

#include <algorithm>

#include "active_daemon.hpp"
#include "daemon/hug_request.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr Duration glow = 2s;

}  // namespace

// --- control thread ---

// The sending switch does not matter: it is about touches that may be meant for something else on the screen.
Json ActiveDaemon::order_hug(const Json& request) {
  const auto wanted = read_hug_request(request);
  if (!wanted) return {{"error", wanted.error().message}};
  if (stop_.stopped()) return {{"error", "everything is stopped here: run `telehug resume` first"}};
  const auto connected = connections();
  if (!any_alive(connected)) return {{"error", "no peer is connected: there is nobody to hug"}};
  const auto listens = [](const ConnectionStatus& wearer) { return wearer.peer.alive && !wearer.stopped_by_peer; };
  if (std::ranges::none_of(connected, listens))
    return {{"error", "the other side has stopped everything, and must resume first"}};
  const HugOrder order{.duration = wanted->duration.value_or(HugOrder{}.duration), .strength = wanted->strength};
  hug_order_.put(order);
  return {{"side", "active"}, {"hug", "begun"}};
}

// --- touch thread ---

void ActiveDaemon::serve_hugs(Timestamp now) {
  HugPlayer& hug = touches_.hug();
  if (const auto order = hug_order_.try_take()) {
    if (!hug.runs()) hugs_begun_.add();
    hug.begin(*order, now);
  }
  if (!anybody_listens(now) || stop_.stopped()) hug.break_off();
}

// --- housekeeping ---

void ActiveDaemon::show_hugs() {
  SeenHug seen;
  while (shown_hugs_.pop(seen)) {
    log_about({.stage = "hug", .peer = seen.from}, spdlog::level::info, fmt::format("{} hugs you", seen.from));
    control_->broadcast({{"event", "hug"}, {"side", "active"}, {"from", seen.from}, {"strength", seen.hug.strength}});
    if (config_.hug.notify) desktop_notifier_.show({.title = "A hug", .body = fmt::format("{} hugs you.", seen.from)});
    glows_until_ = clock_.now() + glow;
    const std::lock_guard lock(words_mutex_);
    last_hug_ = seen;
  }
  desktop_notifier_.serve();
  const std::string& problem = desktop_notifier_.problem();
  if (!problem.empty())
    say_hug_.say(spdlog::level::warn, fmt::format("a hug is not shown on the desktop: {}", problem), {.stage = "hug"});
  const std::lock_guard lock(words_mutex_);
  hug_problem_ = problem;
}

Json ActiveDaemon::last_hug_json() const {
  const std::lock_guard lock(words_mutex_);
  if (!last_hug_) return nullptr;
  const auto ago = std::chrono::round<std::chrono::milliseconds>(clock_.now() - last_hug_->hug.time);
  Json hug = {{"s_ago", static_cast<double>(ago.count()) / 1000},
              {"strength", last_hug_->hug.strength},
              {"from", last_hug_->from}};
  if (!hug_problem_.empty()) hug["not_shown"] = hug_problem_;
  return hug;
}

}  // namespace telehug
