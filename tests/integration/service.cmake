# SPDX-License-Identifier: Apache-2.0
telehug_test(test_control_server KIND integration SUBJECT ops
  SOURCES integration/service/control_server_test.cpp integration/service/control_socket_test.cpp
          integration/service/watchers_test.cpp
  DEPS telehug_service)
set_source_files_properties(integration/service/control_server_test.cpp integration/service/watchers_test.cpp
  TARGET_DIRECTORY test_control_server PROPERTIES COMPILE_OPTIONS -Wno-null-dereference)

telehug_test(test_telehug_command KIND integration SUBJECT ops
  SOURCES integration/ctl/telehug_command_test.cpp
  DEPS telehug_service)
add_dependencies(test_telehug_command telehug)

telehug_test(test_pair_command KIND integration SUBJECT link
  SOURCES integration/ctl/pair_command_test.cpp
  DEPS nlohmann_json::nlohmann_json)
add_dependencies(test_pair_command telehug)

add_test(NAME test_units COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/deploy/units_test.sh
  ${CMAKE_BINARY_DIR}/deploy/systemd ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
set_tests_properties(test_units PROPERTIES LABELS "integration;ops" TIMEOUT 60)

telehug_test(test_references KIND integration SUBJECT ops
  SOURCES integration/cli/completions_test.cpp integration/cli/manual_test.cpp
  DEPS telehug_common)
target_compile_definitions(test_references PRIVATE TELEHUG_MANUAL="${CMAKE_BINARY_DIR}/manual")
add_dependencies(test_references telehug_references)

telehug_test(test_config_command KIND integration SUBJECT ops
  SOURCES integration/ctl/config_command_test.cpp
  DEPS telehug_exit_codes nlohmann_json::nlohmann_json)
add_dependencies(test_config_command telehug)

telehug_test(test_doctor KIND integration SUBJECT ops
  SOURCES integration/ctl/doctor_test.cpp
  DEPS telehug_exit_codes nlohmann_json::nlohmann_json)
add_dependencies(test_doctor telehug)

add_test(NAME test_packages COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/deploy/packages_test.sh
  ${PROJECT_SOURCE_DIR} ${CMAKE_BINARY_DIR})
set_tests_properties(test_packages PROPERTIES LABELS "integration;ops" TIMEOUT 600)
