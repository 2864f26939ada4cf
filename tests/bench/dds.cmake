# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_link SOURCES bench/dds/bench_link.cpp DEPS telehug_dds)
