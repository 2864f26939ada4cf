# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_touch SOURCES bench/touch/bench_touch.cpp doubles/allocation_counter.cpp
  DEPS active_app active_calibration active_eval active_finger active_touch telehug_pictures)
