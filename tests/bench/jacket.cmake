# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_jacket SOURCES bench/jacket/bench_jacket.cpp DEPS passive_jacket passive_rendering passive_safety)
