# SPDX-License-Identifier: Apache-2.0
telehug_test(test_calibration KIND unit SUBJECT touch
  SOURCES unit/calibration/calibration_file_test.cpp unit/calibration/screen_border_test.cpp
          unit/calibration/thesis_touch_model_test.cpp
  DEPS active_calibration opencv::imgproc)
