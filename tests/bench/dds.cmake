# SPDX-License-Identifier: Apache-2.0
telehug_program(bench_link SOURCES bench/dds/bench_link.cpp
  DEPS telehug_dds fmt::fmt CLI11::CLI11 nlohmann_json::nlohmann_json)
target_include_directories(bench_link PRIVATE ${PROJECT_SOURCE_DIR}/tests)
set_target_properties(bench_link PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
