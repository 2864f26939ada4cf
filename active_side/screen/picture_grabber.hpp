// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "screen/screen_grabber.hpp"

namespace telehug {

struct PictureGrabberConfig {
  std::filesystem::path path;  // a JPEG or PNG file, or a folder of them, shown in order of their names, over and over
  double rate_hz = 2;          // pictures a second of a folder, > 0
  std::optional<cv::Rect> view;  // the part to look at, px of the picture; none: the whole picture
};

// Takes a picture for the screen: each picture is a whole monitor. A file is read again only when its time or size
// changes, so a picture that stands still costs one stat() a grab.
class PictureGrabber final : public ScreenGrabber {
 public:
  PictureGrabber(PictureGrabberConfig config, const Clock& clock);  // `clock` outlives the grabber

  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return open_; }
  GrabOutcome grab(ScreenPicture& picture) override;
  [[nodiscard]] bool is_live() const override { return false; }
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string last_error() const override { return last_error_; }

 private:
  struct Stamp {
    std::filesystem::path path;
    std::filesystem::file_time_type modified;
    std::uintmax_t bytes = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };

  [[nodiscard]] const std::filesystem::path& due(Timestamp now) const;
  GrabOutcome lose(std::string why);

  PictureGrabberConfig config_;
  const Clock& clock_;
  bool open_ = false;
  Timestamp opened_;
  std::vector<std::filesystem::path> files_;  // not empty while open
  std::optional<Stamp> shown_;                // what the last grab returned; none after `lost`
  std::string last_error_;
};

}  // namespace telehug
