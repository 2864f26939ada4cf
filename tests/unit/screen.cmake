# SPDX-License-Identifier: Apache-2.0
telehug_test(test_x11_values KIND unit SUBJECT face
  SOURCES unit/screen/left_out_areas_test.cpp unit/screen/x11_monitors_test.cpp
  DEPS active_screen)
