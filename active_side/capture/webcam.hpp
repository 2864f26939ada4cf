// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "capture/camera_setup.hpp"
#include "capture/frame_source.hpp"
#include "capture/pace.hpp"
#include "capture/v4l2_calls.hpp"
#include "pictures/jpeg_decoder.hpp"

namespace telehug {

struct WebcamSettings {
  std::string device;  // /dev/v4l/by-id/... (stays the same camera) or /dev/videoN
  ImageSize size{1280, 720};
  double fps = 30;
  CameraSetupSettings setup = {};  // applied whenever it is opened, put back before it is closed
};

// A V4L2 webcam that delivers MJPEG or YUYV. Of several waiting pictures the newest is read. Frames carry the kernel's
// time of taking if it is CLOCK_MONOTONIC, else the time of reading. When the camera is unplugged, read() says `lost`
// and looks for it again at most every 500 ms until close(). It does the same with one whose pictures have lost the
// agreed size or do not come any more.
class Webcam final : public FrameSource {
 public:
  // `clock` and `calls` must outlive the webcam.
  Webcam(WebcamSettings settings, const Clock& clock, V4l2Calls& calls = kernel_v4l2_calls());
  ~Webcam() override;
  Webcam(const Webcam&) = delete;
  Webcam& operator=(const Webcam&) = delete;

  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return fd_ >= 0; }
  void need_rows(RowRange rows) override { rows_ = rows; }
  ReadOutcome read(Frame& frame, Duration timeout) override;
  [[nodiscard]] std::string last_error() const override { return last_error_; }
  [[nodiscard]] std::string name() const override { return "webcam " + settings_.device; }
  [[nodiscard]] std::string setup() const override { return setup_.summary(); }
  [[nodiscard]] ImageSize size() const override { return size_; }

  // What the camera delivers, for people: "1280x720 MJPG, 30 fps", and what was asked for if that is something else.
  // Empty until open.
  [[nodiscard]] const std::string& mode() const noexcept { return mode_; }

  // Pictures that came but could not be decoded; pictures that were passed over for a newer one.
  [[nodiscard]] std::uint64_t broken_frames() const noexcept { return broken_frames_; }
  [[nodiscard]] std::uint64_t skipped_frames() const noexcept { return skipped_frames_; }

 private:
  struct Buffer {
    std::uint8_t* data = nullptr;
    std::size_t length = 0;
  };
  struct Picture {  // a filled buffer that the driver handed over
    std::uint32_t index = 0;
    std::uint32_t bytes = 0;
    std::uint32_t sequence = 0;
    bool damaged = false;
    Timestamp time;
  };

  Status start();
  Status check_device();
  Status choose_format();
  Status try_format(std::uint32_t pixel_format);
  void choose_rate();
  Status map_buffers();
  Status start_stream();
  void stop();

  int dequeue(Picture& picture);
  int queue(std::uint32_t index);
  ReadOutcome decode(const Picture& picture, Frame& frame);
  ReadOutcome lose(int code);
  ReadOutcome let_go(const std::string& why);
  ReadOutcome try_again(Timestamp deadline);
  ReadOutcome broken(std::string why);

  WebcamSettings settings_;
  const Clock& clock_;
  V4l2Calls& calls_;
  CameraSetup setup_;
  JpegDecoder jpeg_;
  RetryGate retry_;
  int fd_ = -1;
  bool wanted_ = false;
  bool streaming_ = false;
  std::vector<Buffer> buffers_;
  std::uint32_t pixel_format_ = 0;
  std::uint32_t bytes_per_line_ = 0;
  ImageSize size_;
  RowRange rows_;  // that are needed
  std::string mode_;
  std::uint32_t driver_sequence_ = 0;
  bool first_since_start_ = true;
  Timestamp last_picture_;  // when one came, or the stream was started
  std::uint64_t sequence_ = 0;
  int odd_sizes_ = 0;  // pictures of another size than was agreed, in a row
  std::uint64_t broken_frames_ = 0;
  std::uint64_t skipped_frames_ = 0;
  std::string last_error_;
};

}  // namespace telehug
