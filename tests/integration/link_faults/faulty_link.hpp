// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "integration/app/running_pair.hpp"
#include "integration/link_faults/fault_table.hpp"
#include "netlab/hidden_pc.hpp"
#include "netlab/two_homes.hpp"

namespace telehug {

// Both daemons as a pair in two homes, with a finger that rests on the child's picture for ever, so that whenever
// everything works a motor runs.
class FaultyLink {
 public:
  enum class Pairing { done, left_to_the_test };
  // `wearer_at`: where the parent's PC dials the wearer's, if they are to have a WireGuard tunnel.
  explicit FaultyLink(Pairing pairing = Pairing::done, const std::string& wearer_at = "");

  TwoHomes homes;
  RunningPair pair;

  // Puts that home's PC behind a router, before anything is started.
  HiddenPc& hide(Home home) { return hidden_[static_cast<std::size_t>(home)].emplace(homes, home); }
  // Where that home's PC is.
  [[nodiscard]] const NetNamespace& network(Home home) const;

  void start_active();
  void start_passive();
  // Runs a program in a home to its end.
  [[nodiscard]] Outcome run(Home home, const std::vector<std::string>& command) const;
  // Everything from nothing. False if the finger is not felt.
  bool start_all();
  // Waits until a motor runs and has run without a gap for a while. After a break motors may run, lose the sender's
  // heartbeat once more and run again.
  [[nodiscard]] bool settled() const;

  // From what the time until silence counts.
  enum class Since { last_arrival, cause };
  // Breaks something for so long, mends it, and waits until the finger is felt again.
  FaultRow interrupt(const std::string& fault, Since since, Duration lasts, const std::function<void()>& break_it,
                     const std::function<void()>& mend_it);
  // Something bad that goes on for as long as `endure` takes, in which touches should be felt.
  FaultRow disturb(const std::string& fault, const std::function<void()>& endure, const std::function<void()>& mend_it);
  // Something that happens once, and after which touches are felt on or, after a pause, again: "off" and "back" both
  // count from it. Without a pause both are 0.
  FaultRow step(const std::string& fault, const std::function<void()>& happen);

  // What the parent's home said from the start of its daemon until the finger was felt.
  [[nodiscard]] const std::vector<CapturedPacket>& first_words() const noexcept { return first_words_; }

 private:
  [[nodiscard]] FeltTimes felt_times() const { return FeltTimes(pair.pins()); }
  void note_return(FaultRow& row, Timestamp mended) const;

  std::array<std::optional<HiddenPc>, 2> hidden_;
  std::vector<CapturedPacket> first_words_;
};

}  // namespace telehug
