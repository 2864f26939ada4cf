// SPDX-License-Identifier: Apache-2.0
//
// The real kernel's device, where this user may make one.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <libevdev/libevdev.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "local_touch/uinput_touchscreen.hpp"

namespace telehug {
namespace {

constexpr ScreenSize screen{376, 301, 1280, 1024};

// udev gives the node its rights some time after the kernel made it.
int open_soon(const std::string& node) {
  const auto end = std::chrono::steady_clock::now() + 5s;
  int fd = -1;
  while (fd < 0 && std::chrono::steady_clock::now() < end) {
    fd = open(node.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) std::this_thread::sleep_for(10ms);
  }
  return fd;
}

TEST(TheKernelsTouchscreen, ShowsTheTouchesToItsReaders) {
  if (access("/dev/uinput", W_OK) != 0) GTEST_SKIP() << "/dev/uinput is not there or not writable";
  UinputTouchscreen touchscreen;
  const Status opened = touchscreen.open(screen);
  ASSERT_TRUE(opened) << opened.error().message;
  const std::string node = touchscreen.name().substr(std::string("touchscreen ").size());
  const int fd = open_soon(node);
  if (fd < 0) GTEST_SKIP() << node << " is not readable by this user";
  libevdev* device = nullptr;
  ASSERT_EQ(libevdev_new_from_fd(fd, &device), 0);
  EXPECT_STREQ(libevdev_get_name(device), UinputTouchscreen::device_name);
  EXPECT_STREQ(libevdev_get_phys(device), UinputTouchscreen::device_phys);
  EXPECT_EQ(libevdev_has_property(device, INPUT_PROP_DIRECT), 1);
  EXPECT_EQ(libevdev_get_num_slots(device), 10);
  EXPECT_EQ(libevdev_get_abs_resolution(device, ABS_MT_POSITION_X), 100);
  EXPECT_EQ(libevdev_get_abs_maximum(device, ABS_MT_POSITION_Y), 30100);

  ASSERT_TRUE(touchscreen.send({{.id = 5, .phase = Phase::down, .screen = {100, 50}, .frame_time = {}}}, Timestamp{}));
  input_event event{};
  while (libevdev_next_event(device, LIBEVDEV_READ_FLAG_NORMAL, &event) == LIBEVDEV_READ_STATUS_SUCCESS) {
  }
  EXPECT_GE(libevdev_get_slot_value(device, 0, ABS_MT_TRACKING_ID), 0);
  EXPECT_EQ(libevdev_get_slot_value(device, 0, ABS_MT_POSITION_X), 10000);
  EXPECT_EQ(libevdev_get_slot_value(device, 0, ABS_MT_POSITION_Y), 5000);
  EXPECT_EQ(libevdev_get_event_value(device, EV_KEY, BTN_TOUCH), 1);

  ASSERT_TRUE(touchscreen.send({}, Timestamp{}));
  while (libevdev_next_event(device, LIBEVDEV_READ_FLAG_NORMAL, &event) == LIBEVDEV_READ_STATUS_SUCCESS) {
  }
  EXPECT_EQ(libevdev_get_slot_value(device, 0, ABS_MT_TRACKING_ID), -1);
  EXPECT_EQ(libevdev_get_event_value(device, EV_KEY, BTN_TOUCH), 0);
  libevdev_free(device);
  close(fd);
}

}  // namespace
}  // namespace telehug
