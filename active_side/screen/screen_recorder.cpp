// SPDX-License-Identifier: Apache-2.0
#include "screen/screen_recorder.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <utility>

#include "pictures/jpeg_encoder.hpp"

namespace telehug {
namespace {

constexpr int jpeg_quality = 92;

}  // namespace

ScreenRecorder::ScreenRecorder(ScreenGrabber& grabber, std::filesystem::path folder, double rate_hz, const Clock& clock)
    : grabber_(grabber),
      folder_(std::move(folder)),
      period_(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1 / rate_hz))),
      clock_(clock) {}

Status ScreenRecorder::begin() {
  if (Status opened = grabber_.open(); !opened) return opened;
  if (Status made = make_private_folder(folder_ / "screen"); !made) return made;
  auto times = PrivateFile::create(folder_ / "screen_times.csv");
  if (!times) return times.error();
  times_.emplace(std::move(*times));
  next_look_ = clock_.now();
  return times_->append("frame,monotonic_ns,x_px,y_px,monitor_width_px,monitor_height_px\n");
}

Status ScreenRecorder::look() {
  const Timestamp now = clock_.now();
  if (!times_ || now < next_look_) return Done{};
  next_look_ = now + period_;
  const GrabOutcome outcome = grabber_.grab(picture_);
  problem_ = outcome == GrabOutcome::lost ? grabber_.last_error() : "";
  if (outcome != GrabOutcome::changed) return Done{};
  Status written = write(picture_);
  if (!written) times_.reset();
  return written;
}

// The line comes after its picture: a picture without a line, as a killed recorder leaves it, is left out at replay.
Status ScreenRecorder::write(const ScreenPicture& picture) {
  if (picture.bgr.type() == CV_8UC4) {
    cv::cvtColor(picture.bgr, bgr_, cv::COLOR_BGRA2BGR);
  } else {
    bgr_ = picture.bgr;
  }
  const auto jpeg = encode_jpeg(bgr_, jpeg_quality);
  if (!jpeg) return jpeg.error();
  const std::string name = fmt::format("{:05}", pictures_ + 1);
  const std::filesystem::path file = folder_ / "screen" / (name + ".jpg");
  if (Status written = write_private_file(file, *jpeg); !written) return written;
  Status listed = times_->append(fmt::format("{},{},{},{},{},{}\n", name, to_ns(picture.time), picture.origin_px.x,
                                             picture.origin_px.y, picture.monitor.width_px, picture.monitor.height_px));
  if (listed) ++pictures_;
  return listed;
}

}  // namespace telehug
