// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <boost/circular_buffer.hpp>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/clock.hpp"
#include "touch/contact_state.hpp"

namespace telehug {

// From the touch thread to pages that are used with the fingers (live topic "fingers"): what touches the screen in each
// frame. While one follows, touches are meant for it and for nobody else.
class FingerFeed {
 public:
  // A page that is loaded anew, or left for another one, does not let touches out in between.
  static constexpr Duration lingers = 2s;

  // Any thread: does a page use the fingers?
  [[nodiscard]] bool wanted() const noexcept { return wanted_; }

  // Touch thread: what there is in this frame. Kept only while it is wanted; allocates nothing and never waits.
  void put(const ContactStates& contacts, Timestamp frame_time);

  // --- housekeeping's thread ---

  // Does any page follow now? Once a round.
  void follow(bool followed, Timestamp now);

  // If there is anything new: {"frames": [{"sequence", "frame_time_ns", "contacts": [{"id", "phase", "x_mm",
  // "y_mm"}]}]}, oldest first. Pages may miss news, of which there is only the newest: each repeats the frames before,
  // so that there are about those of a quarter of a second. No frames: they are no longer wanted, and what was told
  // before is over.
  [[nodiscard]] std::optional<nlohmann::json> news();

 private:
  struct FingerFrame {
    std::uint64_t sequence = 0;
    Timestamp time;
    ContactStates contacts;
  };
  static constexpr std::size_t most_frames = 64;  // that housekeeping may be late by
  static constexpr std::size_t repeated = 8;

  std::atomic<bool> wanted_ = false;
  std::uint64_t sequence_ = 0;  // touch thread: of the newest frame that was wanted
  boost::lockfree::spsc_queue<FingerFrame, boost::lockfree::capacity<most_frames>> fresh_;
  Timestamp followed_;
  bool over_ = false;  // and not told yet
  boost::circular_buffer<FingerFrame> newest_{most_frames};
};

}  // namespace telehug
