# SPDX-License-Identifier: Apache-2.0
telehug_program(bench_face SOURCES bench/body_map/bench_face.cpp
  DEPS active_body_map telehug_pictures fmt::fmt nlohmann_json)
