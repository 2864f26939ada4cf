// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "capture/pace.hpp"

namespace telehug {

// When a virtual rig takes its pictures. Their numbers go on from one opening to the next.
class RigPace {
 public:
  // `real_time` false: pictures are taken as fast as they are read.
  RigPace(double fps, bool real_time, const Clock& clock, SleepUntil sleep)
      : fps_(fps), real_time_(real_time), clock_(clock), sleep_(std::move(sleep)) {}

  void open() { start_ = clock_.now(); }
  void close() { first_ = next_; }

  // The number of the picture that is due. Nothing: none was until `deadline`.
  std::optional<std::uint64_t> wait_for_picture(Timestamp deadline) {
    if (real_time_) {
      if (!wait_until(time_of(next_), deadline, clock_, sleep_)) return std::nullopt;
      const std::chrono::duration<double> late = clock_.now() - time_of(next_);
      next_ += static_cast<std::uint64_t>(late.count() * fps_);  // as with a webcam the newest frame wins
    }
    return next_++;
  }

  void wait(Timestamp deadline) { wait_until(deadline, deadline, clock_, sleep_); }

  [[nodiscard]] Timestamp now() const { return clock_.now(); }
  [[nodiscard]] std::uint64_t next() const noexcept { return next_; }

  // Of a picture of this opening.
  [[nodiscard]] Timestamp time_of(std::uint64_t number) const {
    const std::chrono::duration<double> seconds(static_cast<double>(number - first_) / fps_);
    return start_ + std::chrono::duration_cast<Duration>(seconds);
  }

 private:
  double fps_;
  bool real_time_;
  const Clock& clock_;
  SleepUntil sleep_;
  Timestamp start_;
  std::uint64_t first_ = 0;  // of this opening
  std::uint64_t next_ = 0;
};

}  // namespace telehug
