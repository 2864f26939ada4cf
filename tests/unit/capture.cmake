# SPDX-License-Identifier: Apache-2.0
telehug_test(test_pictures KIND unit SUBJECT touch
  SOURCES doubles/allocation_counter.cpp unit/pictures/jpeg_decoder_test.cpp unit/pictures/jpeg_rows_test.cpp
    unit/pictures/picture_file_test.cpp
  DEPS telehug_pictures PkgConfig::libjpeg fmt::fmt)
telehug_test(test_light_meter KIND unit SUBJECT touch
  SOURCES unit/capture/light_meter_test.cpp
  DEPS active_capture)
telehug_test(test_capture KIND unit SUBJECT touch
  SOURCES unit/capture/camera_setup_test.cpp unit/capture/camera_tuning_test.cpp
    unit/capture/frame_check_rows_test.cpp unit/capture/frame_check_test.cpp doubles/allocation_counter.cpp
    unit/capture/make_frame_source_test.cpp unit/capture/recording_test.cpp unit/capture/rig_directory_test.cpp
    unit/capture/webcam_device_test.cpp unit/capture/webcam_test.cpp
  DEPS active_capture fmt::fmt)
telehug_test(test_virtual_rig KIND unit SUBJECT touch
  SOURCES unit/capture/directed_rig_test.cpp unit/capture/hand_path_test.cpp
    unit/capture/hand_shape_test.cpp unit/capture/pinhole_camera_test.cpp unit/capture/random_rig_test.cpp
    unit/capture/rig_features_test.cpp unit/capture/touch_script_test.cpp
    unit/capture/virtual_rig_test.cpp
  DEPS active_capture fmt::fmt)
