# SPDX-License-Identifier: Apache-2.0
add_library(running_pair STATIC integration/app/running_pair.cpp)
target_include_directories(running_pair PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(running_pair PUBLIC demonstration telehug_daemon telehug_pairing)
target_compile_definitions(running_pair PRIVATE TELEHUG_FIXTURES="${PROJECT_SOURCE_DIR}/tests/fixtures"
  TELEHUG_BIN="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}" TELEHUG_SOURCE="${PROJECT_SOURCE_DIR}")
telehug_settings(running_pair)
add_dependencies(running_pair telehug telehug-active telehug-passive telehug-jacket-sim)

telehug_test(test_app_touch_to_pin KIND integration SUBJECT jacket
  SOURCES integration/app/touch_to_pin_test.cpp DEPS running_pair)
telehug_test(test_app_silence KIND integration SUBJECT jacket
  SOURCES integration/app/silence_test.cpp DEPS running_pair)
# It measures how long real processes take: beside other tests it would measure those.
set_tests_properties(test_app_silence PROPERTIES RUN_SERIAL TRUE)
telehug_test(test_app_recovery KIND integration SUBJECT jacket
  SOURCES integration/app/recovery_test.cpp DEPS running_pair)
telehug_test(test_app_stop KIND integration SUBJECT ops
  SOURCES integration/app/stop_test.cpp DEPS running_pair)
telehug_test(test_app_consent KIND integration SUBJECT jacket
  SOURCES integration/app/consent_test.cpp DEPS running_pair)
telehug_test(test_app_metrics KIND integration SUBJECT ops
  SOURCES integration/app/metrics_test.cpp DEPS running_pair telehug_daemon)
telehug_test(test_app_log KIND integration SUBJECT ops
  SOURCES integration/app/log_test.cpp DEPS running_pair)
telehug_test(test_app_reload KIND integration SUBJECT ops
  SOURCES integration/app/reload_test.cpp DEPS running_pair)
telehug_test(test_app_pages KIND integration SUBJECT web
  SOURCES integration/app/pages_test.cpp DEPS running_pair)
telehug_test(test_app_fingers_on_pages KIND integration SUBJECT web
  SOURCES integration/app/fingers_on_pages_test.cpp DEPS running_pair)
telehug_test(test_app_paired KIND integration SUBJECT link
  SOURCES integration/app/paired_test.cpp DEPS running_pair)
telehug_test(test_app_several KIND integration SUBJECT link
  SOURCES integration/app/several_test.cpp DEPS running_pair)
telehug_test(test_app_nobody_to_touch KIND integration SUBJECT ops
  SOURCES integration/app/nobody_to_touch_test.cpp DEPS running_pair telehug_pictures)
telehug_test(test_app_bad_input KIND integration SUBJECT ops
  SOURCES integration/app/bad_input_test.cpp DEPS running_pair)
telehug_test(test_app_local_touch KIND integration SUBJECT touch
  SOURCES integration/app/local_touch_test.cpp DEPS running_pair PkgConfig::liblo)
telehug_test(test_app_record_screen KIND integration SUBJECT face
  SOURCES integration/app/record_screen_test.cpp DEPS running_pair active_screen)
telehug_test(test_app_chat_on_screen KIND integration SUBJECT face
  SOURCES integration/app/chat_on_screen_test.cpp DEPS running_pair telehug_pictures opencv::imgproc PkgConfig::xcb PkgConfig::xtest)
telehug_test(test_app_demo KIND integration SUBJECT ops
  SOURCES integration/app/demo_test.cpp DEPS running_pair)
add_dependencies(test_app_demo telehug-demo)
telehug_test(test_app_look KIND integration SUBJECT face
  SOURCES integration/app/look_test.cpp DEPS running_pair)
telehug_test(test_app_hug KIND integration SUBJECT jacket
  SOURCES integration/app/hug_test.cpp DEPS running_pair PkgConfig::sdbus)
set_tests_properties(test_app_hug PROPERTIES RUN_SERIAL TRUE)  # as test_app_silence
telehug_test(test_app_jacket_command KIND integration SUBJECT jacket
  SOURCES integration/app/jacket_command_test.cpp DEPS running_pair)
telehug_test(test_app_heaters KIND integration SUBJECT jacket
  SOURCES integration/app/heaters_test.cpp DEPS running_pair)
set_tests_properties(test_app_heaters PROPERTIES RUN_SERIAL TRUE)  # as test_app_silence
telehug_test(test_app_felt_feedback KIND integration SUBJECT jacket
  SOURCES integration/app/felt_feedback_test.cpp DEPS running_pair)
telehug_test(test_app_panel KIND integration SUBJECT jacket
  SOURCES integration/app/panel_test.cpp DEPS running_pair)
set_tests_properties(test_app_panel PROPERTIES RUN_SERIAL TRUE)  # as test_app_silence
