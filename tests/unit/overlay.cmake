# SPDX-License-Identifier: Apache-2.0
telehug_test(test_overlay_values KIND unit SUBJECT face
  SOURCES unit/overlay/key_combination_test.cpp unit/overlay/outline_test.cpp
  DEPS active_overlay)
