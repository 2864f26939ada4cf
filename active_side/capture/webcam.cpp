// SPDX-License-Identifier: Apache-2.0
#include "capture/webcam.hpp"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "capture/webcam_device.hpp"
#include "capture/yuyv.hpp"

namespace telehug {
namespace {

constexpr std::uint32_t wanted_buffers = 4;  // one being filled, one being read, two against hiccups
constexpr int most_odd_sizes = 15;           // half a second; then the camera is set up again
constexpr Duration longest_silence = 5s;     // some need two to begin; then the camera is set up again
constexpr Duration oldest_believable = 10s;  // a kernel time before that is no time of taking

std::string fourcc(std::uint32_t format) {
  std::string name;
  for (int shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>((format >> shift) & 0x7F);
    name += letter >= ' ' ? letter : '?';
  }
  return name;
}

// V4L2's structs are cleared before use; most calls demand it.
template <typename Struct>
Struct capture_struct() {
  Struct cleared{};
  cleared.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  return cleared;
}

bool says_device_is_gone(int code) {
  return code == -ENODEV || code == -EIO || code == -ENXIO || code == -EBADF;
}

}  // namespace

Webcam::Webcam(WebcamSettings settings, const Clock& clock, V4l2Calls& calls)
    : settings_(std::move(settings)), clock_(clock), calls_(calls), setup_(settings_.setup, calls) {}

Webcam::~Webcam() {
  stop();
}

Status Webcam::open() {
  wanted_ = true;
  if (is_open()) return Done{};
  retry_.tried(clock_.now());
  Status started = start();
  if (!started) {
    stop();
    last_error_ = started.error().message;
  }
  return started;
}

void Webcam::close() {
  wanted_ = false;
  stop();
}

Status Webcam::start() {
  const int fd = calls_.open(settings_.device);
  if (fd < 0) return webcam_failure(settings_.device, "opened", fd);
  fd_ = fd;
  for (const auto step : {&Webcam::check_device, &Webcam::choose_format, &Webcam::map_buffers, &Webcam::start_stream}) {
    if (Status done = (this->*step)(); !done) return done;
  }
  setup_.apply(settings_.device);
  return Done{};
}

void Webcam::stop() {
  if (!is_open()) return;
  setup_.put_back();
  if (streaming_) {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    calls_.ioctl(fd_, VIDIOC_STREAMOFF, &type);
  }
  for (const Buffer& buffer : buffers_)
    calls_.unmap(buffer.data, buffer.length);
  calls_.close(fd_);
  buffers_.clear();
  streaming_ = false;
  fd_ = -1;
  size_ = {};
  mode_.clear();
}

Status Webcam::check_device() {
  v4l2_capability capability{};
  if (const int code = calls_.ioctl(fd_, VIDIOC_QUERYCAP, &capability); code < 0)
    return webcam_failure(settings_.device, "asked what it is", code);
  const std::uint32_t can =
      (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? capability.device_caps : capability.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0) {
    return Error{
        fmt::format("{} delivers no pictures (webcams have further devices for data about them); choose the "
                    "one that ends in video-index0 under /dev/v4l/by-id",
                    settings_.device)};
  }
  return Done{};
}

// MJPEG first: at 1280x720 most webcams reach 30 fps over USB 2 only with it.
Status Webcam::choose_format() {
  Status chosen = try_format(V4L2_PIX_FMT_MJPEG);
  if (!chosen) chosen = try_format(V4L2_PIX_FMT_YUYV);
  if (chosen) choose_rate();
  return chosen;
}

Status Webcam::try_format(std::uint32_t pixel_format) {
  auto format = capture_struct<v4l2_format>();
  format.fmt.pix.width = static_cast<std::uint32_t>(settings_.size.width_px);
  format.fmt.pix.height = static_cast<std::uint32_t>(settings_.size.height_px);
  format.fmt.pix.pixelformat = pixel_format;
  format.fmt.pix.field = V4L2_FIELD_ANY;
  // The driver answers with the nearest that it offers, which may be another format altogether.
  if (const int code = calls_.ioctl(fd_, VIDIOC_S_FMT, &format); code < 0)
    return webcam_failure(settings_.device, "set to a picture format", code);
  const v4l2_pix_format& got = format.fmt.pix;
  if (got.pixelformat != pixel_format) {
    return Error{fmt::format("{} delivers {} but neither MJPG nor YUYV; choose another webcam", settings_.device,
                             fourcc(got.pixelformat))};
  }
  if (got.width < 16 || got.height < 16 || got.width > 8192 || got.height > 8192 || got.width % 2 != 0) {
    return Error{fmt::format("{} offers pictures of {}x{} pixels, which can't be used", settings_.device, got.width,
                             got.height)};
  }
  pixel_format_ = got.pixelformat;
  bytes_per_line_ = std::max(got.bytesperline, got.width * 2);
  size_ = {static_cast<int>(got.width), static_cast<int>(got.height)};
  return Done{};
}

void Webcam::choose_rate() {
  auto rate = capture_struct<v4l2_streamparm>();
  rate.parm.capture.timeperframe = {1000, static_cast<std::uint32_t>(std::lround(1000 * settings_.fps))};
  double fps = 0;  // unknown: not every driver can be asked
  if (calls_.ioctl(fd_, VIDIOC_S_PARM, &rate) == 0 && rate.parm.capture.timeperframe.numerator > 0) {
    const v4l2_fract& time = rate.parm.capture.timeperframe;
    fps = static_cast<double>(time.denominator) / time.numerator;
  }
  mode_ = fmt::format("{}x{} {}", size_.width_px, size_.height_px, fourcc(pixel_format_));
  if (fps > 0) mode_ += fmt::format(", {:.4g} fps", fps);
  const bool other_size = size_.width_px != settings_.size.width_px || size_.height_px != settings_.size.height_px;
  if (other_size || (fps > 0 && std::abs(fps - settings_.fps) > 0.1)) {
    mode_ += fmt::format(" (nearest to {}x{}, {:.4g} fps)", settings_.size.width_px, settings_.size.height_px,
                         settings_.fps);
  }
}

Status Webcam::map_buffers() {
  auto request = capture_struct<v4l2_requestbuffers>();
  request.count = wanted_buffers;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int code = calls_.ioctl(fd_, VIDIOC_REQBUFS, &request); code < 0)
    return webcam_failure(settings_.device, "given buffers", code);
  if (request.count < 2) return webcam_failure(settings_.device, "given buffers", -ENOMEM);
  for (std::uint32_t index = 0; index < request.count; ++index) {
    auto buffer = capture_struct<v4l2_buffer>();
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    if (const int code = calls_.ioctl(fd_, VIDIOC_QUERYBUF, &buffer); code < 0)
      return webcam_failure(settings_.device, "given buffers", code);
    void* address = calls_.map(fd_, buffer.length, buffer.m.offset);
    if (address == nullptr) return webcam_failure(settings_.device, "given buffers", -ENOMEM);
    buffers_.push_back({static_cast<std::uint8_t*>(address), buffer.length});
    if (const int code = queue(index); code < 0) return webcam_failure(settings_.device, "given buffers", code);
  }
  return Done{};
}

Status Webcam::start_stream() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int code = calls_.ioctl(fd_, VIDIOC_STREAMON, &type); code < 0)
    return webcam_failure(settings_.device, "started", code);
  streaming_ = first_since_start_ = true;
  odd_sizes_ = 0;
  last_picture_ = clock_.now();
  return Done{};
}

ReadOutcome Webcam::read(Frame& frame, Duration timeout) {
  const Timestamp deadline = clock_.now() + timeout;
  if (!is_open()) return try_again(deadline);

  Picture newest;
  int code = dequeue(newest);
  while (code == -EAGAIN) {
    const Timestamp now = clock_.now();
    if (now - last_picture_ >= longest_silence) return let_go("delivers no pictures; plug it in again");
    if (now >= deadline) return ReadOutcome::timeout;
    const int ready = calls_.wait(fd_, deadline - now);
    if (ready < 0) return lose(ready);
    if (ready > 0) code = dequeue(newest);
  }
  if (code < 0) return lose(code);
  last_picture_ = clock_.now();

  // Newest wins: what waited behind this one is newer.
  for (Picture newer; (code = dequeue(newer)) == 0; newest = newer) {
    ++skipped_frames_;
    if (const int queued = queue(newest.index); queued < 0) return lose(queued);
  }
  if (code != -EAGAIN && says_device_is_gone(code)) return lose(code);

  sequence_ += first_since_start_ ? 1 : std::max<std::uint32_t>(1, newest.sequence - driver_sequence_);
  driver_sequence_ = newest.sequence;
  first_since_start_ = false;
  const ReadOutcome outcome = decode(newest, frame);
  if (const int queued = queue(newest.index); queued < 0 && outcome != ReadOutcome::frame) return lose(queued);
  if (odd_sizes_ >= most_odd_sizes) return let_go("delivers pictures of another size and is set up again");
  return outcome;  // a picture that was read counts; if the camera is gone, the next read() notices
}

int Webcam::dequeue(Picture& picture) {
  auto buffer = capture_struct<v4l2_buffer>();
  buffer.memory = V4L2_MEMORY_MMAP;
  const int code = calls_.ioctl(fd_, VIDIOC_DQBUF, &buffer);
  if (code < 0) return code;
  if (buffer.index >= buffers_.size()) return -EIO;
  picture.index = buffer.index;
  picture.sequence = buffer.sequence;
  picture.damaged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
  picture.bytes = buffer.bytesused <= buffers_[buffer.index].length ? buffer.bytesused : 0;
  const Timestamp now = clock_.now();
  picture.time = now;
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    const Timestamp taken{std::chrono::seconds(buffer.timestamp.tv_sec) +
                          std::chrono::microseconds(buffer.timestamp.tv_usec)};
    if (taken <= now && taken > now - oldest_believable) picture.time = taken;
  }
  return 0;
}

int Webcam::queue(std::uint32_t index) {
  auto buffer = capture_struct<v4l2_buffer>();
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return calls_.ioctl(fd_, VIDIOC_QBUF, &buffer);
}

ReadOutcome Webcam::decode(const Picture& picture, Frame& frame) {
  if (picture.damaged) return broken("the driver says that a picture was damaged on its way");
  const std::span<const std::uint8_t> bytes(buffers_[picture.index].data, picture.bytes);
  if (pixel_format_ == V4L2_PIX_FMT_MJPEG) {
    if (const Status decoded = jpeg_.decode(bytes, frame.bgr, rows_); !decoded) return broken(decoded.error().message);
    if (frame.bgr.cols != size_.width_px || frame.bgr.rows != size_.height_px) {
      ++odd_sizes_;
      return broken(fmt::format("a picture of {}x{} pixels came", frame.bgr.cols, frame.bgr.rows));
    }
  } else {
    const std::size_t needed = static_cast<std::size_t>(bytes_per_line_) * static_cast<std::size_t>(size_.height_px);
    if (bytes.size() < needed)
      return broken(fmt::format("a picture of {} instead of {} bytes came", bytes.size(), needed));
    const cv::Mat yuyv(size_.height_px, size_.width_px, CV_8UC2, buffers_[picture.index].data, bytes_per_line_);
    convert_yuyv(yuyv, frame.bgr, rows_);
  }
  odd_sizes_ = 0;
  frame.rows = rows_;
  frame.sequence = sequence_;
  frame.time = picture.time;
  return ReadOutcome::frame;
}

ReadOutcome Webcam::broken(std::string why) {
  ++broken_frames_;
  last_error_ = fmt::format("{}: {}", settings_.device, why);
  return ReadOutcome::broken;
}

ReadOutcome Webcam::lose(int code) {
  return let_go(fmt::format("is gone ({}); plug it in again", std::strerror(-code)));
}

ReadOutcome Webcam::let_go(const std::string& why) {
  last_error_ = settings_.device + ' ' + why;
  stop();
  retry_.tried(clock_.now());
  return ReadOutcome::lost;
}

ReadOutcome Webcam::try_again(Timestamp deadline) {
  if (!wanted_) last_error_ = fmt::format("{} is closed", settings_.device);
  const Timestamp now = clock_.now();
  const Timestamp wake = wanted_ ? std::min(retry_.next(now), deadline) : deadline;
  if (wake > now) calls_.wait(-1, wake - now);
  if (!wanted_ || clock_.now() < retry_.next(now)) return ReadOutcome::lost;
  return open() ? ReadOutcome::timeout : ReadOutcome::lost;
}

}  // namespace telehug
