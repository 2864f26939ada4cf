// SPDX-License-Identifier: Apache-2.0
#include "daemon/link_keeper.hpp"

#include <fmt/core.h>
#include <malloc.h>
#include <unistd.h>

#include <fstream>
#include <mutex>
#include <utility>

#include "dds/library_log.hpp"
#include "service/log.hpp"

namespace telehug {
namespace {

constexpr Duration memory_interval = 10s;
// Between two rounds of housekeeping; shorter than the silence after which the other side gives this one up.
constexpr Duration shortest_hold_up = 3s;

// Of this program, in bytes; 0 if it is not known.
std::uint64_t resident_memory() {
  std::uint64_t pages = 0;
  std::ifstream statm("/proc/self/statm");
  statm >> pages >> pages;  // the second number
  return statm ? pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

std::optional<AddressWatcher>& watch(std::optional<AddressWatcher>& watcher, bool loopback_only) {
  if (!loopback_only) watcher.emplace();
  return watcher;
}

// Before Fast DDS has anything to say. Several connections share one.
DdsSettings with_library_log_taken_over(DdsSettings settings) {
  static std::once_flag done;
  std::call_once(done, tell_library_log,
                 [](const std::string& text) { log_about({.stage = "link"}, spdlog::level::warn, text); });
  return settings;
}

}  // namespace

LinkKeeper::LinkKeeper(DdsSettings settings, const Clock& clock)
    : settings_(with_library_log_taken_over(std::move(settings))),
      clock_(clock),
      // Watched before the participant is made, so that no change falls between the two.
      supervisor_(!watch(addresses_, settings_.loopback_only) || !addresses_->addresses().empty()),
      participant_(std::in_place, settings_),
      told_({{"replaced", 0}, {"last_reason", ""}}) {
  supervisor_.made(LinkCause::first, clock_.now());
}

void LinkKeeper::serve(const PeerState& peer, const Endpoints& endpoints) {
  const Timestamp now = clock_.now();
  if (addresses_) look_at_network(now);
  if (served_at_ && now - *served_at_ >= shortest_hold_up) supervisor_.held_up(now);
  look_at_peer(peer, now);
  look_at_strangers(now);
  look_at_memory(now);
  if (const auto cause = supervisor_.due(now)) replace(*cause, endpoints);
  served_at_ = clock_.now();
}

nlohmann::json LinkKeeper::status() const {
  const std::lock_guard lock(told_mutex_);
  return told_;
}

void LinkKeeper::look_at_network(Timestamp now) {
  if (addresses_->changed()) supervisor_.addresses_changed(!addresses_->addresses().empty(), now);
  if (sleep_.resumed(now, time_since_boot())) supervisor_.resumed(now);
}

void LinkKeeper::look_at_peer(const PeerState& peer, Timestamp now) {
  if (peer.alive) supervisor_.peer_heard(now);
  if (const std::uint64_t signs = participant_ ? participant_->signs_of_peers() : 0; signs != signs_) {
    if (signs > signs_) supervisor_.peer_noticed(now);
    signs_ = signs;
  }
  if (peer.session == peer_session_) return;
  if (peer_session_ != SessionId{}) supervisor_.peer_restarted();
  peer_session_ = peer.session;
}

void LinkKeeper::look_at_strangers(Timestamp now) {
  static const std::set<std::string> only_loopback{"lo 127.0.0.1"};
  if (!participant_) return;
  strangers_.look(participant_->stranger(), participant_->refusals(),
                  addresses_ ? addresses_->addresses() : only_loopback, now);
}

void LinkKeeper::look_at_memory(Timestamp now) {
  if (now - memory_looked_at_ < memory_interval) return;
  memory_looked_at_ = now;
  if (const std::uint64_t bytes = resident_memory(); bytes != 0) supervisor_.memory_used(bytes, now);
}

void LinkKeeper::replace(LinkCause cause, const Endpoints& endpoints) {
  // The old one goes first: its ports are the next one's.
  endpoints.disconnect();
  participant_.reset();
  // Its threads' heaps are not those of the next one's: what is free there would never be used again.
  malloc_trim(0);
  signs_ = 0;
  strangers_.participant_replaced();
  try {
    endpoints.connect(participant_.emplace(settings_));
  } catch (const std::exception& problem) {
    endpoints.disconnect();
    participant_.reset();
    supervisor_.creation_failed(clock_.now());
    log_about({.stage = "link"}, spdlog::level::warn,
              fmt::format("the connection can't be set up: {}; it is tried again by itself", problem.what()));
    return;
  }
  supervisor_.made(cause, clock_.now());
  log_about({.stage = "link"}, spdlog::level::info, fmt::format("the connection was set up anew: {}", sentence(cause)));
  const std::lock_guard lock(told_mutex_);
  told_ = {{"replaced", supervisor_.replaced()}, {"last_reason", sentence(cause)}};
}

}  // namespace telehug
