# SPDX-License-Identifier: Apache-2.0
telehug_test(test_setup KIND unit SUBJECT touch
  SOURCES unit/setup/border_band_test.cpp unit/setup/calibration_session_rules_test.cpp unit/setup/dot_plan_test.cpp
    unit/setup/finger_rest_test.cpp unit/setup/setup_json_test.cpp unit/setup/still_picture_test.cpp
  DEPS active_setup opencv::imgproc)
