# SPDX-License-Identifier: Apache-2.0
telehug_test(test_x11_grabber KIND integration SUBJECT face
  SOURCES integration/screen_x11/x11_display_test.cpp integration/screen_x11/x11_monitor_grab_test.cpp
          integration/screen_x11/x11_monitor_sizes_test.cpp integration/screen_x11/x11_window_grab_test.cpp
  DEPS active_screen_x11)
telehug_test(test_portal_grabber KIND integration SUBJECT face
  SOURCES integration/screen_portal/portal_consent_test.cpp integration/screen_portal/portal_pictures_test.cpp
    integration/screen_portal/portal_trouble_test.cpp doubles/drawn_screen.cpp doubles/fake_portal.cpp
  DEPS active_screen_portal opencv::imgproc PkgConfig::pipewire PkgConfig::sdbus)
# PipeWire's macros cast in C's way.
set_source_files_properties(doubles/drawn_screen.cpp TARGET_DIRECTORY test_portal_grabber PROPERTIES
  COMPILE_OPTIONS -Wno-old-style-cast)
telehug_test(test_notifications KIND integration SUBJECT ops
  SOURCES integration/notify/desktop_notifier_test.cpp
  DEPS active_notify PkgConfig::sdbus)
