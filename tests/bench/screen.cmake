# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_screen SOURCES bench/screen/bench_x11_grab.cpp DEPS active_screen_x11)
