# SPDX-License-Identifier: Apache-2.0
telehug_test(test_calibration_session KIND pipeline SUBJECT touch TIMEOUT 900
  SOURCES pipeline/setup/calibration_session_test.cpp doubles/random_set_up.cpp
  DEPS active_setup active_capture telehug_pictures opencv::imgproc)
