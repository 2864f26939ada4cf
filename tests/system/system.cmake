# SPDX-License-Identifier: Apache-2.0

# telehug_system_test(NAME SOURCES file... DEPS target...)
# A program that tests/system/run starts in a guest; no CTest entry, since nothing of it can pass outside of one.
function(telehug_system_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} EXCLUDE_FROM_ALL ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_DEPS} GTest::gmock GTest::gtest_main)
  telehug_settings(${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/system)
  add_dependencies(system_tests ${name})
endfunction()

add_custom_target(system_tests)
# What is in the packages.
add_dependencies(system_tests telehug telehug-active telehug-passive telehug-jacket-sim telehug_jacket_firmware
  telehug_references)
telehug_system_test(test_gpio_lines SOURCES system/gpio_lines_test.cpp DEPS passive_gpio fmt::fmt)
