# SPDX-License-Identifier: Apache-2.0
telehug_program(bench_touch SOURCES bench/touch/bench_touch.cpp doubles/allocation_counter.cpp
  DEPS active_calibration active_eval active_finger active_touch telehug_pictures fmt::fmt
       nlohmann_json::nlohmann_json)
target_include_directories(bench_touch PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_definitions(bench_touch PRIVATE TELEHUG_FIXTURES="${CMAKE_CURRENT_SOURCE_DIR}/fixtures")
set_target_properties(bench_touch PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bench)
