# SPDX-License-Identifier: Apache-2.0
telehug_test(test_calibration KIND unit SUBJECT touch
  SOURCES unit/calibration/calibration_file_test.cpp unit/calibration/screen_border_test.cpp
          unit/calibration/thesis_touch_model_test.cpp
  DEPS active_calibration opencv::imgproc)
telehug_test(test_rig_solver KIND unit SUBJECT touch TIMEOUT 900
  SOURCES doubles/allocation_counter.cpp unit/calibration/rig_accuracy_test.cpp unit/calibration/rig_camera_test.cpp
          unit/calibration/rig_solver_test.cpp
  DEPS active_calibration)
telehug_test(test_rig_calibration KIND unit SUBJECT touch TIMEOUT 900
  SOURCES unit/calibration/border_choice_test.cpp unit/calibration/calibration_policy_test.cpp
          unit/calibration/consistent_touches_test.cpp
          unit/calibration/rig_calibration_file_test.cpp unit/calibration/two_touch_calibration_test.cpp
  DEPS active_calibration)
telehug_test(test_calibration_dot KIND unit SUBJECT touch SOURCES unit/calibration/calibration_dot_test.cpp
  DEPS active_calibration opencv::imgproc)
telehug_test(test_mark_search KIND unit SUBJECT touch SOURCES unit/calibration/mark_search_test.cpp
  DEPS active_calibration opencv::imgproc)
telehug_test(test_touch_calibration KIND unit SUBJECT touch SOURCES unit/detection/touch_calibration_test.cpp
  DEPS active_detection opencv::imgproc)
telehug_test(test_drift_watch KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/calibration/drift_watch_test.cpp DEPS active_calibration)
telehug_test(test_net KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/net/nets_test.cpp unit/net/tensors_test.cpp DEPS active_net)
telehug_test(test_finger KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/finger/aligned_patch_test.cpp unit/finger/finger_colour_test.cpp
          unit/finger/finger_edges_test.cpp unit/finger/thesis_detector_test.cpp
  DEPS active_finger telehug_pictures opencv::imgproc)
telehug_test(test_finger_stages KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/finger/background_strip_test.cpp unit/finger/border_strip_test.cpp
          unit/finger/mirror_evidence_test.cpp unit/finger/overview_test.cpp unit/finger/tip_patch_test.cpp
  DEPS active_finger opencv::core)
telehug_test(test_background KIND unit SUBJECT touch
  SOURCES unit/finger/background_file_test.cpp unit/finger/background_learner_test.cpp
  DEPS active_finger telehug_pictures)
telehug_test(test_touch KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/touch/assignment_test.cpp unit/touch/contact_smoothing_test.cpp
          unit/touch/contact_tracker_test.cpp unit/touch/finger_tracks_test.cpp unit/touch/gesture_recogniser_test.cpp
          unit/touch/sample_sequences_test.cpp unit/touch/screen_points_test.cpp unit/touch/touch_decision_test.cpp
  DEPS active_touch active_calibration)
telehug_test(test_eval KIND unit SUBJECT touch
  SOURCES unit/eval/error_group_test.cpp unit/eval/error_statistics_test.cpp unit/eval/failure_test.cpp
          unit/eval/rigs_table_test.cpp unit/eval/touch_score_test.cpp
  DEPS active_eval)
telehug_test(test_eval_report KIND unit SUBJECT touch
  SOURCES unit/eval_report/html_report_test.cpp unit/eval_report/svg_test.cpp DEPS active_eval_report)
