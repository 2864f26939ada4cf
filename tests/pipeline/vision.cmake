# SPDX-License-Identifier: Apache-2.0
telehug_test(test_touch_samples KIND pipeline SUBJECT touch
  SOURCES pipeline/eval/touch_evaluation_test.cpp pipeline/eval/touch_samples_test.cpp
  DEPS active_eval telehug_pictures)
telehug_test(test_virtual_rig_dots KIND pipeline SUBJECT touch SOURCES pipeline/eval/virtual_rig_dots_test.cpp
  DEPS active_detection active_capture)
telehug_test(test_rows_needed KIND pipeline SUBJECT touch SOURCES pipeline/eval/rows_needed_test.cpp
  DEPS active_detection active_capture)
telehug_test(test_eval_rigs KIND pipeline SUBJECT touch SOURCES pipeline/eval_report/eval_rigs_test.cpp
  DEPS active_eval_report)
telehug_test(test_rendered_fingers KIND pipeline SUBJECT touch TIMEOUT 900
  SOURCES doubles/allocation_counter.cpp pipeline/eval/rendered_fingers_test.cpp
  DEPS active_detection active_capture)
