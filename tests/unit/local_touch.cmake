# SPDX-License-Identifier: Apache-2.0
telehug_test(test_local_touch KIND unit SUBJECT touch
  SOURCES unit/local_touch/local_touch_outputs_test.cpp unit/local_touch/uinput_touchscreen_test.cpp
  DEPS active_local_touch PkgConfig::libevdev)
