# SPDX-License-Identifier: Apache-2.0
telehug_test(test_setup KIND unit SUBJECT touch
  SOURCES unit/setup/border_band_test.cpp unit/setup/calibration_session_rules_test.cpp unit/setup/dot_plan_test.cpp
    unit/setup/finger_rest_test.cpp unit/setup/setup_json_test.cpp unit/setup/still_picture_test.cpp
  DEPS active_setup opencv::imgproc)
telehug_test(test_setup_run KIND unit SUBJECT web
  SOURCES unit/setup_run/advice_texts_test.cpp unit/setup_run/live_jpeg_test.cpp unit/setup_run/newest_monitors_test.cpp
    unit/setup_run/setup_choice_test.cpp
    unit/setup_run/setup_desk_test.cpp unit/setup_run/setup_memory_test.cpp unit/setup_run/setup_offers_test.cpp
    unit/setup_run/setup_run_test.cpp
  DEPS active_setup_run telehug_pictures opencv::imgproc fmt::fmt)
