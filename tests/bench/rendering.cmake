# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_rendering
  SOURCES bench/rendering/accuracy.cpp bench/rendering/accuracy_picture.cpp bench/rendering/bench_rendering.cpp
  DEPS passive_jacket passive_rendering passive_safety)
