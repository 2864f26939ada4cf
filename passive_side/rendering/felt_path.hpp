// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>

#include "common/clock.hpp"
#include "common/units.hpp"

namespace telehug {

// How fast a felt place may move.
struct Pace {
  double fh_s = 0;        // when it hurries
  double at_once_fh = 0;  // how far it may jump after a pause
};

// However much faster than its pace a finger is: the felt place is at most so far behind it. (Seen and felt touch are
// taken for one up to about 300 ms, Shimada 2009.)
inline constexpr Duration longest_lag = 200ms;

// The way of one contact over the body as it is felt. A finger of usual speed is followed at once. One that is faster
// than motors can tell is followed along its whole way, also where events were lost, but no faster than the pace; and
// the more of the way is left, the faster, so that it never lags for long. Times do not go back.
class FeltPath {
 public:
  FeltPath(BodyPoint begin, Timestamp now);

  // Where the finger is now. What is no place is passed over.
  void lead(BodyPoint place, Timestamp now);

  // The finger is gone; what is left of its way is felt until `now + longest_lag`.
  void end(Timestamp now) { arrives_ = now + longest_lag; }

  // Moves on. Calls walked(from, to) for each straight piece of it.
  template <typename Walked>
  void advance(Pace pace, Timestamp now, Walked walked) {
    double step_fh = allowance(pace, now);
    while (!ahead_.empty() && step_fh > 0) {
      const BodyPoint from = place_;
      step_fh = step_to_next(step_fh);
      walked(from, place_);
    }
    left_fh_ = step_fh;
  }

  [[nodiscard]] BodyPoint place() const noexcept { return place_; }
  [[nodiscard]] bool arrived() const noexcept { return ahead_.empty(); }
  // Of the finger, over a while that levels out how unsure its place is.
  [[nodiscard]] double speed_fh_s() const noexcept { return speed_fh_s_; }

 private:
  [[nodiscard]] double allowance(Pace pace, Timestamp now);
  [[nodiscard]] double remaining_fh() const;
  double step_to_next(double step_fh);

  BodyPoint place_;
  boost::container::static_vector<BodyPoint, 32> ahead_;  // where the finger has been since, oldest first
  double left_fh_ = 0;                                    // of what was allowed before
  Timestamp at_;
  Timestamp arrives_ = Timestamp::max();
  BodyPoint speed_from_;
  Timestamp speed_since_;
  double speed_fh_s_ = 0;
};

}  // namespace telehug
