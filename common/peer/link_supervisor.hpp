// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "common/clock.hpp"

namespace telehug {

// Why a participant is made.
enum class LinkCause {
  first,              // there was none yet
  creation_failed,    // the last one could not be made
  addresses_changed,  // of this PC: a participant never adapts to new ones
  network_came,       // likewise, after there had been no network at all
  resumed,            // this PC was suspended
  held_up,            // this program did not run for a while, and the peer may have given it up meanwhile
  peer_silent,        // DDS Security may wait for ever for a peer that it once dropped
  peer_restarts,      // each restart of the peer leaves memory behind in a participant
  memory_grown,       // likewise, as measured
};

[[nodiscard]] std::string_view sentence(LinkCause cause) noexcept;

struct LinkLimits {
  Duration quiet = 300ms;           // without a further change, before a change counts as complete
  Duration longest_unrest = 5s;     // changes that never end count as complete after that
  Duration heard_within = 500ms;    // the peer counts as heard for so long
  Duration longest_deferral = 30s;  // of a change, because the peer is heard in spite of it
  Duration after_hold_up = 1s;      // the peer is heard by then, or it is lost
  Duration first_silence = 4s;      // doubled with each replacement that did not help
  Duration longest_silence = 30s;
  Duration first_retry = 1s;  // of making a participant; doubled likewise
  Duration longest_retry = 30s;
  Duration memory_settles = 60s;                          // what a new participant takes at its start is no leak
  Duration between_leaks = 10min;                         // at least, between replacements because of memory
  std::uint64_t memory_growth = std::uint64_t{64} << 20;  // bytes
  std::uint64_t peer_restarts = 400;                      // 60 to 75 kB each: about 30 MB
};

// Decides when the participant is to be replaced. Pure logic: whoever serves it tells what happened and asks due().
// Not for use by several threads at a time.
class LinkSupervisor {
 public:
  // `network`: is there one at the start? Without one nothing is made.
  explicit LinkSupervisor(bool network, const LinkLimits& limits = {}) : limits_(limits), network_(network) {}

  // What happened. `network`: has this PC an address now?
  void addresses_changed(bool network, Timestamp now) noexcept;
  void resumed(Timestamp now) noexcept;
  void held_up(Timestamp now) noexcept { running_again_at_ = now; }
  void peer_heard(Timestamp now) noexcept;
  // Somebody was discovered or authenticated: a handshake may be under way, which over a slow way takes seconds, or may
  // have got stuck. Not proof of anything, so it puts a replacement off for no longer than longest_silence.
  void peer_noticed(Timestamp now) noexcept { noticed_at_ = now; }
  void peer_restarted() noexcept { ++restarts_; }
  void memory_used(std::uint64_t bytes, Timestamp now) noexcept;

  // Is a participant to be made now, in place of the one there is? Says so until it is told what became of it.
  [[nodiscard]] std::optional<LinkCause> due(Timestamp now) const noexcept;

  void made(LinkCause cause, Timestamp now) noexcept;
  void creation_failed(Timestamp now) noexcept;

  // Participants made in place of another, and why the last one was.
  [[nodiscard]] std::uint64_t replaced() const noexcept { return replaced_; }
  [[nodiscard]] std::optional<LinkCause> last_cause() const noexcept { return last_cause_; }

 private:
  struct Change {
    LinkCause cause;
    Timestamp first;  // since the participant was made
    Timestamp unrest_since;
    Timestamp last;
  };

  [[nodiscard]] bool heard_lately(Timestamp now) const noexcept;
  [[nodiscard]] bool lost_while_held_up(Timestamp now) const noexcept;
  [[nodiscard]] bool silent_too_long(Timestamp now) const noexcept;
  [[nodiscard]] bool change_complete(Timestamp now) const noexcept;
  [[nodiscard]] std::optional<LinkCause> leak(Timestamp now) const noexcept;
  void note(LinkCause cause, Timestamp now) noexcept;

  LinkLimits limits_;
  bool network_;
  std::optional<Change> change_;
  std::optional<Timestamp> made_at_;  // of the participant there is
  std::optional<Timestamp> retry_at_;
  Duration retry_ = Duration::zero();
  std::optional<Timestamp> heard_at_;
  std::optional<Timestamp> noticed_at_;
  std::optional<Timestamp> running_again_at_;  // until it is known whether the peer is still heard
  Duration silence_ = Duration::zero();        // the next one that is too long; zero: the first
  std::uint64_t restarts_ = 0;
  std::optional<std::uint64_t> memory_at_first_;
  std::uint64_t memory_ = 0;
  std::uint64_t replaced_ = 0;
  std::optional<LinkCause> last_cause_;
};

}  // namespace telehug
