# SPDX-License-Identifier: Apache-2.0
telehug_test(test_x11_grabber KIND integration SUBJECT face
  SOURCES integration/screen/x11_display_test.cpp integration/screen/x11_monitor_grab_test.cpp
          integration/screen/x11_window_grab_test.cpp
  DEPS active_screen)
