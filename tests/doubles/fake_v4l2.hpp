// SPDX-License-Identifier: Apache-2.0
//
// A webcam as the kernel's V4L2 shows it: formats that are answered with the nearest, buffers that are mapped, queued
// and dequeued in order, frames that are lost while no buffer is queued, unplugging, other users. It may be open more
// than once; its controls outlive who set them, but not an unplugging. Those that an automatic rules refuse to be set.
#pragma once

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "capture/v4l2_calls.hpp"
#include "doubles/fake_clock.hpp"

namespace telehug {

class FakeV4l2 final : public V4l2Calls {
 public:
  explicit FakeV4l2(FakeClock& clock) : clock_(clock) {}

  // What the device is; change it before open().
  std::string device = "/dev/video0";
  bool plugged = true;
  int open_error = 0;  // e.g. EACCES
  bool busy = false;   // another program streams
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<std::uint32_t> formats{V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_YUYV};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes{{64, 48}, {128, 72}};
  std::uint32_t fps = 30;
  std::uint32_t time_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  std::uint32_t buffers_granted = 4;
  std::function<void()> while_waiting;  // called once at the next wait() for a picture

  struct Control {
    std::uint32_t id = 0;
    std::string name;
    std::uint32_t type = V4L2_CTRL_TYPE_INTEGER;
    std::int32_t minimum = 0;
    std::int32_t maximum = 0;
    std::int32_t default_value = 0;
    std::int32_t value = 0;
    std::uint32_t ruled_by = 0;  // an automatic ...
    std::int32_t free_at = 0;    // ... and its value at which it rules nothing
    std::uint32_t flags = 0;
  };
  std::vector<Control> controls;  // ids rise
  std::uint32_t refused = 0;      // a control that can't be set
  int control_changes = 0;
  [[nodiscard]] std::int32_t control(std::uint32_t id) const { return find(id)->value; }

  // What was seen of its user.
  int opened = 0;
  int open_now = 0;
  int mapped_now = 0;
  int waits = 0;
  bool streaming = false;

  // A picture was taken now. It is lost if no buffer is queued, and cut off if it is larger than the buffer.
  void take(const std::vector<std::uint8_t>& picture, std::uint32_t extra_flags = 0) {
    const std::uint32_t number = sequence_++;
    if (!plugged || !streaming || queued_.empty()) return;
    Slot& slot = slots_[queued_.front()];
    slot.bytes = std::min(picture.size(), slot.memory.size());
    std::copy_n(picture.begin(), slot.bytes, slot.memory.begin());
    slot.sequence = number;
    slot.flags = time_flags | extra_flags;
    slot.time = clock_.now();
    done_.push_back(queued_.front());
    queued_.pop_front();
  }
  void unplug() {
    plugged = false;
    for (Control& known : controls)
      known.value = known.default_value;
  }
  [[nodiscard]] std::size_t queued() const { return queued_.size(); }

  int open(const std::string& path) override {
    if (!plugged || path != device) return -ENOENT;
    if (open_error != 0) return -open_error;
    ++opened;
    ++open_now;
    return next_descriptor_++;
  }
  void close(int fd) override {
    if (!known(fd)) return;
    --open_now;
    if (fd == streamer_) forget_buffers();
  }
  int ioctl(int fd, unsigned long request, void* argument) override {
    if (!known(fd) || open_now == 0) return -EBADF;
    if (!plugged) return -ENODEV;
    switch (request) {
      case VIDIOC_QUERYCAP:
        return query(*static_cast<v4l2_capability*>(argument));
      case VIDIOC_S_FMT:
        return set_format(*static_cast<v4l2_format*>(argument));
      case VIDIOC_S_PARM:
        return set_rate(*static_cast<v4l2_streamparm*>(argument));
      case VIDIOC_REQBUFS:
        streamer_ = fd;
        return request_buffers(*static_cast<v4l2_requestbuffers*>(argument));
      case VIDIOC_QUERYCTRL:
        return query_control(*static_cast<v4l2_queryctrl*>(argument));
      case VIDIOC_G_CTRL:
        return get_control(*static_cast<v4l2_control*>(argument));
      case VIDIOC_S_CTRL:
        return set_control(*static_cast<v4l2_control*>(argument));
      case VIDIOC_QUERYBUF:
        return query_buffer(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_QBUF:
        return queue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_DQBUF:
        return dequeue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        return stream(true);
      case VIDIOC_STREAMOFF:
        return stream(false);
      default:
        return -ENOTTY;
    }
  }
  void* map(int fd, std::size_t length, std::size_t offset) override {
    const std::size_t index = offset / offset_step;
    if (!known(fd) || index >= slots_.size() || length != slots_[index].memory.size()) return nullptr;
    ++mapped_now;
    return slots_[index].memory.data();
  }
  void unmap(void* /*address*/, std::size_t /*length*/) override { --mapped_now; }

  int wait(int fd, Duration timeout) override {
    ++waits;
    if (fd >= 0) {
      if (auto happening = std::exchange(while_waiting, nullptr)) happening();
      if (!plugged || !streaming) return -ENODEV;
      if (!done_.empty()) return 1;
    }
    clock_.advance(timeout);
    return 0;
  }

 private:
  static constexpr int first_descriptor = 42;
  static constexpr std::size_t offset_step = 1 << 20;

  struct Slot {
    std::vector<std::uint8_t> memory;
    std::size_t bytes = 0;
    std::uint32_t sequence = 0;
    std::uint32_t flags = 0;
    Timestamp time;
    bool with_driver = false;
  };

  [[nodiscard]] bool known(int fd) const { return fd >= first_descriptor && fd < next_descriptor_; }

  [[nodiscard]] std::vector<Control>::const_iterator find(std::uint32_t id) const {
    return std::find_if(controls.begin(), controls.end(), [&](const Control& control) { return control.id == id; });
  }
  [[nodiscard]] bool ruled(const Control& control) const {
    const auto automatic = find(control.ruled_by);
    return automatic != controls.end() && automatic->value != control.free_at;
  }
  int query_control(v4l2_queryctrl& query) const {
    const std::uint32_t id = query.id & ~V4L2_CTRL_FLAG_NEXT_CTRL;
    const bool next = id != query.id;
    const auto control = std::find_if(controls.begin(), controls.end(), [&](const Control& candidate) {
      return next ? candidate.id > id : candidate.id == id;
    });
    if (control == controls.end()) return -EINVAL;
    query = {};
    query.id = control->id;
    query.type = control->type;
    std::strncpy(reinterpret_cast<char*>(query.name), control->name.c_str(), sizeof(query.name) - 1);
    query.minimum = control->minimum;
    query.maximum = control->maximum;
    query.step = 1;
    query.default_value = control->default_value;
    query.flags = control->flags | (ruled(*control) ? V4L2_CTRL_FLAG_INACTIVE : 0U);
    return 0;
  }
  int get_control(v4l2_control& wanted) const {
    const auto control = find(wanted.id);
    if (control == controls.end()) return -EINVAL;
    wanted.value = control->value;
    return 0;
  }
  int set_control(const v4l2_control& wanted) {
    const auto control = find(wanted.id);
    if (control == controls.end()) return -EINVAL;
    if (wanted.value < control->minimum || wanted.value > control->maximum) return -ERANGE;
    if (ruled(*control) || wanted.id == refused) return -EIO;
    controls[static_cast<std::size_t>(control - controls.begin())].value = wanted.value;
    ++control_changes;
    return 0;
  }

  int query(v4l2_capability& answer) const {
    answer.capabilities = capabilities | V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE;  // of all of its devices
    answer.device_caps = capabilities;
    return 0;
  }
  int set_format(v4l2_format& format) {
    if (format.type != V4L2_BUF_TYPE_VIDEO_CAPTURE) return -EINVAL;
    if (busy || !slots_.empty()) return -EBUSY;
    v4l2_pix_format& pix = format.fmt.pix;
    if (std::find(formats.begin(), formats.end(), pix.pixelformat) == formats.end()) pix.pixelformat = formats.front();
    const auto distance = [&](const auto& size) {
      return std::abs(static_cast<int>(size.first) - static_cast<int>(pix.width)) +
             std::abs(static_cast<int>(size.second) - static_cast<int>(pix.height));
    };
    const auto nearest = std::min_element(sizes.begin(), sizes.end(),
                                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    pix.width = nearest->first;
    pix.height = nearest->second;
    pix.bytesperline = pix.pixelformat == V4L2_PIX_FMT_YUYV ? 2 * pix.width : 0;
    pix.sizeimage = 2 * pix.width * pix.height;
    picture_bytes_ = pix.sizeimage;
    return 0;
  }
  int set_rate(v4l2_streamparm& rate) const {
    rate.parm.capture.timeperframe = {1, fps};
    return 0;
  }
  int request_buffers(v4l2_requestbuffers& request) {
    if (request.memory != V4L2_MEMORY_MMAP || picture_bytes_ == 0) return -EINVAL;
    if (busy) return -EBUSY;
    request.count = std::min(request.count, buffers_granted);
    slots_.assign(request.count, Slot{std::vector<std::uint8_t>(picture_bytes_), 0, 0, 0, {}, false});
    return 0;
  }
  int query_buffer(v4l2_buffer& buffer) const {
    if (buffer.index >= slots_.size()) return -EINVAL;
    buffer.length = static_cast<std::uint32_t>(slots_[buffer.index].memory.size());
    buffer.m.offset = static_cast<std::uint32_t>(buffer.index * offset_step);
    return 0;
  }
  int queue(const v4l2_buffer& buffer) {
    if (buffer.index >= slots_.size() || slots_[buffer.index].with_driver) return -EINVAL;
    slots_[buffer.index].with_driver = true;
    queued_.push_back(buffer.index);
    return 0;
  }
  int dequeue(v4l2_buffer& buffer) {
    if (!streaming) return -EINVAL;
    if (done_.empty()) return -EAGAIN;
    buffer.index = done_.front();
    done_.pop_front();
    Slot& slot = slots_[buffer.index];
    slot.with_driver = false;
    buffer.bytesused = static_cast<std::uint32_t>(slot.bytes);
    buffer.length = static_cast<std::uint32_t>(slot.memory.size());
    buffer.sequence = slot.sequence;
    buffer.flags = slot.flags;
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(slot.time.time_since_epoch()).count();
    buffer.timestamp = {us / 1'000'000, us % 1'000'000};
    return 0;
  }
  int stream(bool on) {
    if (on && slots_.empty()) return -EINVAL;
    streaming = on;
    if (on) {
      sequence_ = 0;
    } else {
      queued_.clear();
      done_.clear();
    }
    return 0;
  }
  void forget_buffers() {
    streaming = false;
    slots_.clear();
    queued_.clear();
    done_.clear();
  }

  FakeClock& clock_;
  int next_descriptor_ = first_descriptor;
  int streamer_ = -1;
  std::size_t picture_bytes_ = 0;
  std::uint32_t sequence_ = 0;
  std::vector<Slot> slots_;
  std::deque<std::uint32_t> queued_;
  std::deque<std::uint32_t> done_;
};

}  // namespace telehug
