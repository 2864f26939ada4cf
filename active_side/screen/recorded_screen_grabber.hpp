// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "screen/recorded_screen.hpp"
#include "screen/screen_grabber.hpp"

namespace telehug {

// Shows again what the screen of a recording showed: at each time since open() what was shown that long after the first
// picture. The last picture stays.
class RecordedScreenGrabber final : public ScreenGrabber {
 public:
  // `recording`: the folder that holds screen/ and screen_times.csv. `clock` outlives the grabber.
  RecordedScreenGrabber(std::filesystem::path recording, const Clock& clock);

  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return open_; }
  GrabOutcome grab(ScreenPicture& picture) override;
  [[nodiscard]] bool is_live() const override { return false; }
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string last_error() const override { return last_error_; }

 private:
  [[nodiscard]] std::size_t due(Timestamp now) const;
  GrabOutcome lose(std::string why);

  std::filesystem::path recording_;
  const Clock& clock_;
  bool open_ = false;
  Timestamp opened_;
  std::vector<RecordedScreenPicture> pictures_;  // not empty while open
  std::optional<std::size_t> shown_;             // the newest; none since open()
  std::string last_error_;
};

}  // namespace telehug
