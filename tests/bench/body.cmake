# SPDX-License-Identifier: Apache-2.0
telehug_program(bench_face SOURCES bench/body_map/bench_face.cpp
  DEPS active_body_map telehug_pictures opencv::imgproc fmt::fmt CLI11::CLI11 nlohmann_json::nlohmann_json)
target_include_directories(bench_face PRIVATE ${PROJECT_SOURCE_DIR}/tests)
target_compile_definitions(bench_face PRIVATE TELEHUG_FIXTURES="${PROJECT_SOURCE_DIR}/tests/fixtures")
set_target_properties(bench_face PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
