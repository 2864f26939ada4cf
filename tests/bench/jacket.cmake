# SPDX-License-Identifier: Apache-2.0
add_executable(bench_jacket bench/jacket/bench_jacket.cpp)
target_link_libraries(bench_jacket PRIVATE passive_jacket passive_safety fmt::fmt)
target_include_directories(bench_jacket PRIVATE ${PROJECT_SOURCE_DIR}/tests)
target_compile_definitions(bench_jacket PRIVATE TELEHUG_SOURCE="${PROJECT_SOURCE_DIR}")
telehug_settings(bench_jacket)
set_target_properties(bench_jacket PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
