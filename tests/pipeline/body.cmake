# SPDX-License-Identifier: Apache-2.0
telehug_test(test_face_pipeline KIND pipeline SUBJECT face
  SOURCES pipeline/body_map/body_map_step_test.cpp pipeline/body_map/show_boxes_test.cpp
    pipeline/face/blaze_face_finder_test.cpp pipeline/face/haar_face_finder_test.cpp
    pipeline/face/make_face_finder_test.cpp
    pipeline/eval_face/eval_face_test.cpp
  DEPS active_eval_face active_body_map telehug_pictures)
telehug_test(test_screen KIND pipeline SUBJECT face
  SOURCES pipeline/screen/frame_grabber_sources_test.cpp pipeline/screen/frame_grabber_test.cpp
    pipeline/screen/picture_grabber_test.cpp pipeline/screen/recorded_screen_grabber_test.cpp pipeline/screen/screen_recorder_test.cpp
    pipeline/screen/screen_recording_test.cpp
  DEPS active_screen active_capture telehug_pictures fmt::fmt)
