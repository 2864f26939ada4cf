# SPDX-License-Identifier: Apache-2.0
telehug_test(test_touch_samples KIND pipeline SUBJECT touch SOURCES pipeline/eval/touch_samples_test.cpp
  DEPS active_eval telehug_pictures)
