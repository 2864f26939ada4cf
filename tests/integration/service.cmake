# SPDX-License-Identifier: Apache-2.0
telehug_test(test_control_server KIND integration SUBJECT ops
  SOURCES integration/service/control_server_test.cpp integration/service/control_socket_test.cpp
          integration/service/watchers_test.cpp
  DEPS telehug_service)
set_source_files_properties(integration/service/control_server_test.cpp integration/service/watchers_test.cpp
  TARGET_DIRECTORY test_control_server PROPERTIES COMPILE_OPTIONS -Wno-null-dereference)

telehug_test(test_telehug_command KIND integration SUBJECT ops
  SOURCES integration/ctl/open_command_test.cpp integration/ctl/telehug_command_test.cpp
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
  SOURCES integration/ctl/doctor_test.cpp integration/ctl/firewall_test.cpp
  DEPS telehug_ctl telehug_exit_codes nlohmann_json::nlohmann_json)
add_dependencies(test_doctor telehug)

add_test(NAME test_packages COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/integration/deploy/packages_test.sh
  ${PROJECT_SOURCE_DIR} ${CMAKE_BINARY_DIR})
set_tests_properties(test_packages PROPERTIES LABELS "integration;ops" TIMEOUT 600)

# A real bootloader in a simulated chip is among them: see test_jacket_flash.
telehug_test(test_doctor_set_ups KIND integration SUBJECT ops
  SOURCES integration/ctl/broken_desktop_test.cpp integration/ctl/broken_jacket_test.cpp integration/ctl/broken_pc.cpp
          integration/ctl/broken_pc_test.cpp integration/ctl/simulated_board.cpp doubles/fake_bluez.cpp
  DEPS telehug_exit_codes telehug_pairing telehug_pictures telehug_service jacket_simulator nlohmann_json::nlohmann_json
       PkgConfig::sdbus ${SIMAVR_LIBRARY})
target_include_directories(test_doctor_set_ups SYSTEM PRIVATE ${SIMAVR_INCLUDE_DIR})
target_compile_definitions(test_doctor_set_ups PRIVATE TELEHUG_FIRMWARE_FOLDER="${CMAKE_BINARY_DIR}/firmware")
add_dependencies(test_doctor_set_ups telehug telehug-active telehug-passive telehug-jacket-sim telehug_jacket_firmware)

telehug_test(test_report KIND integration SUBJECT ops
  SOURCES integration/ctl/report_test.cpp
  DEPS telehug_pairing telehug_service nlohmann_json::nlohmann_json)
add_dependencies(test_report telehug telehug-active)
