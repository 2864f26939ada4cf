// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "files/private_file.hpp"
#include "screen/screen_grabber.hpp"

namespace telehug {

// Writes the pictures of a screen into a recording's folder (recorded_screen.hpp), each when it was seen first, and
// none while the screen stands still. Files are the owner's alone (0600, folder 0700). Whatever ends it, what was
// written until then can be replayed.
class ScreenRecorder {
 public:
  // Looks at most `rate_hz` (> 0) times a second. `folder` is there already. `grabber` and `clock` outlive it.
  ScreenRecorder(ScreenGrabber& grabber, std::filesystem::path folder, double rate_hz, const Clock& clock);

  // Opens the grabber and makes the files; fails if `folder` holds pictures of a screen already.
  Status begin();

  // Looks at the screen if it is time to. An error is about writing, and nothing more is written after it; a screen
  // that is lost is no error, see problem().
  Status look();

  // When look() is due.
  [[nodiscard]] Timestamp next_look() const noexcept { return next_look_; }

  [[nodiscard]] int pictures() const noexcept { return pictures_; }  // written

  // Why the last look saw nothing; empty if it did.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
  Status write(const ScreenPicture& picture);

  ScreenGrabber& grabber_;
  std::filesystem::path folder_;
  Duration period_;
  const Clock& clock_;
  Timestamp next_look_;
  std::optional<PrivateFile> times_;
  ScreenPicture picture_;
  cv::Mat bgr_;
  int pictures_ = 0;
  std::string problem_;
};

}  // namespace telehug
