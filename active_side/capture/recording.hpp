// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/frame_source.hpp"
#include "capture/pace.hpp"
#include "capture/rig_directory.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {

struct RecordingSettings {
  std::filesystem::path folder;  // a recording (rig_directory.hpp), or a folder of pictures, perhaps with times.csv
  std::string part;              // of a recording; empty: "sequence", or "frames" if there is none
  bool real_time = true;         // false: as fast as it is read
  bool loop = false;             // begin again after the last picture
  double fps = 30;               // of a recording that has no times.csv; > 0
};

// A recorded session as a camera. Frames carry the times at which they are due, counted from open(), as if taken now.
// In real time it behaves like a webcam: whoever reads too slowly gets the newest picture, and the frames' sequence
// numbers show the gap. Otherwise no frame is left out. open() after close() begins anew.
class Recording final : public FrameSource {
 public:
  // `clock` must outlive the recording.
  Recording(RecordingSettings settings, const Clock& clock, SleepUntil sleep = sleep_until_steady);

  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return open_; }
  void need_rows(RowRange rows) override { rows_ = rows; }
  ReadOutcome read(Frame& frame, Duration timeout) override;
  [[nodiscard]] std::string last_error() const override { return last_error_; }
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] ImageSize size() const override { return size_; }

  // Name of the picture that was read last, as in truth.csv; empty before the first.
  [[nodiscard]] const std::string& frame_name() const noexcept { return frame_name_; }

 private:
  Status load();
  [[nodiscard]] Timestamp due(std::size_t index) const;
  ReadOutcome try_again(Timestamp deadline);

  RecordingSettings settings_;
  const Clock& clock_;
  SleepUntil sleep_;
  PictureReader reader_;
  RetryGate retry_;
  std::vector<RigFrame> frames_;
  std::vector<Duration> offsets_;  // from the first frame
  Duration period_{};              // from the last frame to the first of the next round
  ImageSize size_;
  RowRange rows_;  // that are needed
  bool open_ = false;
  bool wanted_ = false;
  Timestamp start_;
  std::size_t next_ = 0;              // counts on over the rounds of a loop
  std::uint64_t first_sequence_ = 0;  // of this opening
  std::string frame_name_;
  std::string last_error_;
};

}  // namespace telehug
