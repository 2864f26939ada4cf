# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_rig SOURCES bench/capture/bench_virtual_rig.cpp DEPS active_capture opencv::core)
