# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_face SOURCES bench/body_map/bench_face.cpp DEPS active_body_map telehug_pictures opencv::imgproc)
