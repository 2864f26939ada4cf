# SPDX-License-Identifier: Apache-2.0
telehug_test(test_body_map KIND unit SUBJECT face
  SOURCES unit/body_map/body_map_tracker_test.cpp unit/body_map/one_euro_filter_test.cpp
    unit/body_map/screen_scale_test.cpp unit/body_map/vitruvian_grid_test.cpp
  DEPS active_body_map)
telehug_test(test_eval_face KIND unit SUBJECT face
  SOURCES unit/eval_face/face_labels_test.cpp unit/eval_face/face_scores_test.cpp
  DEPS active_eval_face)
telehug_test(test_face KIND unit SUBJECT face
  SOURCES unit/face/inner_change_test.cpp unit/face/remote_face_follower_test.cpp
  DEPS active_face)
