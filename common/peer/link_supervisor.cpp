// SPDX-License-Identifier: Apache-2.0
#include "peer/link_supervisor.hpp"

#include <algorithm>

namespace telehug {
namespace {

Duration longer(Duration before, Duration first, Duration longest) noexcept {
  return before == Duration::zero() ? first : std::min(2 * before, longest);
}

}  // namespace

std::string_view sentence(LinkCause cause) noexcept {
  switch (cause) {
    case LinkCause::first:
      return "telehug started";
    case LinkCause::creation_failed:
      return "the connection could not be set up before";
    case LinkCause::addresses_changed:
      return "this PC's network addresses changed";
    case LinkCause::network_came:
      return "the network came";
    case LinkCause::resumed:
      return "this PC was suspended";
    case LinkCause::held_up:
      return "this program was held up";
    case LinkCause::peer_silent:
      return "the other side fell silent";
    case LinkCause::peer_restarts:
      return "the other side started again many times";
    case LinkCause::memory_grown:
      return "the connection took more and more memory";
  }
  return "";
}

void LinkSupervisor::addresses_changed(bool network, Timestamp now) noexcept {
  // Known until a participant is made: what comes after no network at all is the network.
  const bool came = !network_ || (change_ && change_->cause == LinkCause::network_came);
  network_ = network;
  note(came ? LinkCause::network_came : LinkCause::addresses_changed, now);
}

void LinkSupervisor::resumed(Timestamp now) noexcept {
  note(LinkCause::resumed, now);
}

void LinkSupervisor::peer_heard(Timestamp now) noexcept {
  heard_at_ = now;
  // What is heard before may have waited in a buffer all the time.
  if (running_again_at_ && now - *running_again_at_ >= limits_.after_hold_up) running_again_at_.reset();
  silence_ = Duration::zero();
}

void LinkSupervisor::memory_used(std::uint64_t bytes, Timestamp now) noexcept {
  memory_ = bytes;
  if (!memory_at_first_ && made_at_ && now - *made_at_ >= limits_.memory_settles) memory_at_first_ = bytes;
}

std::optional<LinkCause> LinkSupervisor::due(Timestamp now) const noexcept {
  if (!network_) return std::nullopt;
  if (change_) {
    if (!change_complete(now)) return std::nullopt;  // a participant made now would have the wrong addresses
    const bool deferred = heard_lately(now) && now - change_->first < limits_.longest_deferral;
    if (!deferred) return change_->cause;
  }
  if (retry_at_) return now >= *retry_at_ ? std::optional(LinkCause::creation_failed) : std::nullopt;
  if (!made_at_) return LinkCause::first;
  if (lost_while_held_up(now)) return LinkCause::held_up;
  if (silent_too_long(now)) return LinkCause::peer_silent;
  return leak(now);
}

void LinkSupervisor::made(LinkCause cause, Timestamp now) noexcept {
  if (cause == LinkCause::peer_silent) {
    silence_ = std::min(2 * std::max(silence_, limits_.first_silence), limits_.longest_silence);
  }
  if (cause != LinkCause::first) {
    ++replaced_;
    last_cause_ = cause;
  }
  made_at_ = now;
  running_again_at_.reset();
  change_.reset();
  retry_at_.reset();
  retry_ = Duration::zero();
  restarts_ = 0;
  memory_at_first_.reset();
}

void LinkSupervisor::creation_failed(Timestamp now) noexcept {
  retry_ = longer(retry_, limits_.first_retry, limits_.longest_retry);
  retry_at_ = now + retry_;
  change_.reset();  // the retry takes its place, or else it would be tried again without a pause
}

bool LinkSupervisor::heard_lately(Timestamp now) const noexcept {
  return heard_at_ && now - *heard_at_ < limits_.heard_within;
}

// The peer has made a participant of its own anew meanwhile, whose handshake with this old one may be stuck.
bool LinkSupervisor::lost_while_held_up(Timestamp now) const noexcept {
  const bool waited = running_again_at_ && now - *running_again_at_ >= limits_.after_hold_up;
  return waited && heard_at_ && !heard_lately(now);
}

// A peer that was heard once, or was noticed and never heard: the handshake may be stuck.
bool LinkSupervisor::silent_too_long(Timestamp now) const noexcept {
  if (!heard_at_ && !noticed_at_) return false;
  const Timestamp silent_since = std::max(heard_at_.value_or(*made_at_), *made_at_);
  if (now - silent_since >= limits_.longest_silence) return true;
  const Duration too_long = silence_ == Duration::zero() ? limits_.first_silence : silence_;
  return now - std::max(noticed_at_.value_or(silent_since), silent_since) >= too_long;
}

bool LinkSupervisor::change_complete(Timestamp now) const noexcept {
  return now - change_->last >= limits_.quiet || now - change_->unrest_since >= limits_.longest_unrest;
}

std::optional<LinkCause> LinkSupervisor::leak(Timestamp now) const noexcept {
  if (now - *made_at_ < limits_.between_leaks) return std::nullopt;
  // It costs the touch a moment, so it waits for one without the other side; but not for ever.
  const std::uint64_t patience = heard_lately(now) ? 2 : 1;
  if (restarts_ >= patience * limits_.peer_restarts) return LinkCause::peer_restarts;
  if (memory_at_first_ && memory_ >= *memory_at_first_ + patience * limits_.memory_growth)
    return LinkCause::memory_grown;
  return std::nullopt;
}

void LinkSupervisor::note(LinkCause cause, Timestamp now) noexcept {
  const bool goes_on = change_ && now - change_->last < limits_.quiet;
  change_ = Change{cause, change_ ? change_->first : now, goes_on ? change_->unrest_since : now, now};
  retry_ = Duration::zero();  // what failed before may succeed now
  if (retry_at_) retry_at_ = now;
  silence_ = Duration::zero();
}

}  // namespace telehug
