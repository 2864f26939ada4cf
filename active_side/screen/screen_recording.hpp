// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "screen/screen_recorder.hpp"

namespace telehug {

// Records the screen in a thread of its own, so that writing its pictures costs none of the camera's.
class ScreenRecording {
 public:
  // As ScreenRecorder, with a grabber of its own. `clock` outlives it.
  ScreenRecording(std::unique_ptr<ScreenGrabber> grabber, std::filesystem::path folder, double rate_hz,
                  const Clock& clock);

  // Opens the screen and makes the files; nothing of the screen is written yet.
  Status open() { return recorder_.begin(); }

  void start();

  // It can't write any more; end() says why.
  [[nodiscard]] bool failed() const noexcept { return failed_; }

  // Ends the thread. How many pictures were written; an error if that are none, or if writing failed.
  Result<int> end();

  [[nodiscard]] std::string name() const { return grabber_->name(); }

 private:
  void work(const std::stop_token& stop);

  std::unique_ptr<ScreenGrabber> grabber_;
  ScreenRecorder recorder_;
  Status written_ = Done{};
  std::atomic<bool> failed_ = false;
  std::jthread thread_;
};

}  // namespace telehug
