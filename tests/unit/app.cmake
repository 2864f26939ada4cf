# SPDX-License-Identifier: Apache-2.0
telehug_test(test_boxes_under KIND unit SUBJECT face SOURCES unit/app/boxes_under_test.cpp DEPS active_app)
telehug_test(test_face_worker KIND unit SUBJECT face SOURCES unit/app/face_worker_test.cpp DEPS active_app)
telehug_test(test_screen_source KIND unit SUBJECT face SOURCES unit/app/screen_source_test.cpp DEPS active_app)
telehug_test(test_sending KIND unit SUBJECT face
  SOURCES unit/app/sending_switch_test.cpp unit/app/touched_box_test.cpp DEPS active_app)
telehug_test(test_finger_feed KIND unit SUBJECT web
  SOURCES doubles/allocation_counter.cpp unit/app/finger_feed_test.cpp DEPS active_app)
telehug_test(test_live_touches KIND unit SUBJECT web SOURCES unit/app/live_touches_test.cpp DEPS active_app)
telehug_test(test_hug_back KIND unit SUBJECT ops SOURCES unit/app/hug_back_test.cpp DEPS passive_app)
telehug_test(test_jacket_trial KIND unit SUBJECT jacket SOURCES unit/app/jacket_trial_test.cpp DEPS passive_app)
telehug_test(test_felt_feedback KIND unit SUBJECT jacket
  SOURCES unit/app/felt_drive_test.cpp unit/app/felt_feedback_test.cpp unit/app/felt_pulse_test.cpp
  DEPS active_feedback passive_jacket passive_link)
telehug_test(test_jacket_status KIND unit SUBJECT jacket
  SOURCES unit/app/heater_status_test.cpp unit/app/jacket_status_test.cpp DEPS passive_app)
telehug_test(test_demo_verdict KIND unit SUBJECT touch SOURCES unit/app/demo_verdict_test.cpp DEPS demonstration)
telehug_test(test_consent KIND unit SUBJECT jacket
  SOURCES unit/app/consent_file_test.cpp unit/app/consent_switch_test.cpp unit/app/limit_notes_test.cpp
          unit/app/touches_today_test.cpp
  DEPS passive_app)
