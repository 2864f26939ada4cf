// SPDX-License-Identifier: Apache-2.0
#include "screen/screen_recording.hpp"

#include <fmt/format.h>

#include <condition_variable>
#include <exception>
#include <mutex>
#include <utility>

namespace telehug {

ScreenRecording::ScreenRecording(std::unique_ptr<ScreenGrabber> grabber, std::filesystem::path folder, double rate_hz,
                                 const Clock& clock)
    : grabber_(std::move(grabber)), recorder_(*grabber_, std::move(folder), rate_hz, clock) {}

void ScreenRecording::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void ScreenRecording::work(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  do {  // once at least, however short the recording is
    try {
      written_ = recorder_.look();
    } catch (const std::exception& fault) {  // of a library, on a picture that it can't bear
      written_ = Error{fmt::format("the picture of the screen can't be written: {}", fault.what())};
    }
    failed_ = !written_;
    if (failed_) return;
    stopped.wait_until(lock, stop, recorder_.next_look(), [] { return false; });
  } while (!stop.stop_requested());
}

Result<int> ScreenRecording::end() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  grabber_->close();
  if (!written_) return written_.error();
  if (recorder_.pictures() > 0) return recorder_.pictures();
  return Error{recorder_.problem().empty() ? fmt::format("no picture came from {}", name()) : recorder_.problem()};
}

}  // namespace telehug
