# SPDX-License-Identifier: Apache-2.0
telehug_test(test_calibration KIND unit SUBJECT touch
  SOURCES unit/calibration/calibration_file_test.cpp unit/calibration/screen_border_test.cpp
          unit/calibration/thesis_touch_model_test.cpp
  DEPS active_calibration opencv::imgproc)
telehug_test(test_rig_solver KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/calibration/rig_accuracy_test.cpp unit/calibration/rig_camera_test.cpp
          unit/calibration/rig_solver_test.cpp
  DEPS active_calibration)
telehug_test(test_finger KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/finger/aligned_patch_test.cpp unit/finger/finger_colour_test.cpp
          unit/finger/finger_edges_test.cpp unit/finger/thesis_detector_test.cpp
  DEPS active_finger opencv::imgproc)
telehug_test(test_touch KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/touch/assignment_test.cpp unit/touch/contact_smoothing_test.cpp
          unit/touch/contact_tracker_test.cpp unit/touch/finger_tracks_test.cpp unit/touch/sample_sequences_test.cpp
          unit/touch/screen_points_test.cpp unit/touch/touch_decision_test.cpp
  DEPS active_touch active_calibration)
telehug_test(test_eval KIND unit SUBJECT touch SOURCES unit/eval/touch_score_test.cpp DEPS active_eval)
