// SPDX-License-Identifier: Apache-2.0
//
// The toucher feels something, too (thesis, future work): a small actuator at their finger or under the desk's edge
// answers when the wearer's jacket was driven. It is driven as a jacket is, by the same profile, safety stage, link and
// firmware.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "common/result.hpp"
#include "config/config.hpp"
#include "feedback/felt_drive.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

class FeltFeedback {
 public:
  // Null if no actuator is configured. Errors: faults of the profile, a link that is none.
  [[nodiscard]] static Result<std::unique_ptr<FeltFeedback>> make(const FeedbackConfig& config, const Clock& clock);

  FeltFeedback(JacketProfile profile, std::unique_ptr<JacketLink> link, double strength, const Clock& clock);
  ~FeltFeedback();  // off
  FeltFeedback(const FeltFeedback&) = delete;
  FeltFeedback& operator=(const FeltFeedback&) = delete;

  // From one thread; never waits. An answer that finds 16 waiting is dropped.
  void felt(const Felt& answer) { answers_.push(answer); }
  // While stopped nothing is driven.
  void set_stopped(bool stopped) noexcept { stopped_ = stopped; }

  // What stands between the toucher and feeling something; empty if nothing does.
  [[nodiscard]] std::string problem() const;

 private:
  void loop();
  void serve(Timestamp now);

  const Clock& clock_;
  FeltDrive drive_;  // the thread's
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> ending_ = false;
  boost::lockfree::spsc_queue<Felt, boost::lockfree::capacity<16>> answers_;
  mutable std::mutex mutex_;
  std::string problem_;  // guarded by mutex_
  std::thread thread_;   // last: it uses all of them
};

}  // namespace telehug
