# SPDX-License-Identifier: Apache-2.0
telehug_program(bench_jacket SOURCES bench/jacket/bench_jacket.cpp
  DEPS passive_jacket passive_safety fmt::fmt CLI11::CLI11 nlohmann_json::nlohmann_json)
target_include_directories(bench_jacket PRIVATE ${PROJECT_SOURCE_DIR}/tests)
target_compile_definitions(bench_jacket PRIVATE TELEHUG_SOURCE="${PROJECT_SOURCE_DIR}")
set_target_properties(bench_jacket PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
