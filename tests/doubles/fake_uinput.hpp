// SPDX-License-Identifier: Apache-2.0
//
// /dev/uinput as a test sees it: what device was described, and what a reader of its event node would know after each
// SYN_REPORT (the kernel's protocol B).
#pragma once

#include <libevdev/libevdev.h>
#include <linux/input.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "local_touch/uinput_calls.hpp"

namespace telehug {

class FakeUinput final : public UinputCalls {
 public:
  struct Touch {
    int tracking_id = -1;
    int x = -1;
    int y = -1;
  };

  int error = 0;        // e.g. EACCES: create() fails
  int write_error = 0;  // e.g. ENODEV: writing fails

  // What was seen of its user.
  int devices_now = 0;
  std::string name;
  std::string phys;
  bool direct = false;
  std::map<int, input_absinfo> axes;
  std::map<int, Touch> touching;  // by slot, as of the last report
  std::map<int, int> keys;
  int pointer_x = -1;
  int pointer_y = -1;
  int reports = 0;
  int unfinished = 0;  // events after the last report
  std::vector<int> tracking_ids;

  int create(const libevdev& description, const std::string& path, std::unique_ptr<UinputDevice>& device) override {
    if (error != 0) return -error;
    name = libevdev_get_name(&description);
    phys = path;
    direct = libevdev_has_property(&description, INPUT_PROP_DIRECT) == 1;
    axes.clear();
    for (const int code : {ABS_X, ABS_Y, ABS_MT_SLOT, ABS_MT_TRACKING_ID, ABS_MT_POSITION_X, ABS_MT_POSITION_Y}) {
      if (const input_absinfo* axis = libevdev_get_abs_info(&description, static_cast<unsigned int>(code)))
        axes[code] = *axis;
    }
    touching.clear();
    device = std::make_unique<Device>(*this);
    return 0;
  }

 private:
  class Device final : public UinputDevice {
   public:
    explicit Device(FakeUinput& kernel) : kernel_(kernel) { ++kernel_.devices_now; }
    ~Device() override {
      --kernel_.devices_now;
      kernel_.touching.clear();
    }
    int write(std::span<const input_event> events) override {
      if (kernel_.write_error != 0) return -kernel_.write_error;
      for (const input_event& event : events)
        kernel_.take(event);
      return 0;
    }
    [[nodiscard]] std::string node() const override { return "/dev/input/event99"; }

   private:
    FakeUinput& kernel_;
  };

  void take(const input_event& event) {
    ++unfinished;
    if (event.type == EV_KEY) keys[event.code] = event.value;
    if (event.type == EV_ABS) take_axis(event.code, event.value);
    if (event.type != EV_SYN) return;
    unfinished = 0;
    ++reports;
  }
  void take_axis(int code, int value) {
    if (code == ABS_MT_SLOT) slot_ = value;
    if (code == ABS_MT_TRACKING_ID) {
      if (value < 0) {
        touching.erase(slot_);
      } else {
        touching[slot_].tracking_id = value;
        tracking_ids.push_back(value);
      }
    }
    if (code == ABS_MT_POSITION_X) touching[slot_].x = value;
    if (code == ABS_MT_POSITION_Y) touching[slot_].y = value;
    if (code == ABS_X) pointer_x = value;
    if (code == ABS_Y) pointer_y = value;
  }

  int slot_ = 0;
};

}  // namespace telehug
