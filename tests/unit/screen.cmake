# SPDX-License-Identifier: Apache-2.0
telehug_test(test_x11_values KIND unit SUBJECT face
  SOURCES unit/screen_x11/edid_test.cpp unit/screen_x11/left_out_areas_test.cpp
    unit/screen_x11/x11_monitors_test.cpp
  DEPS active_screen_x11)
telehug_test(test_screen_share KIND unit SUBJECT face
  SOURCES unit/screen_portal/frame_in_memory_test.cpp unit/screen_portal/frame_slot_test.cpp unit/screen_portal/restore_token_test.cpp
  DEPS active_screen_portal)
