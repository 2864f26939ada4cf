# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_jacket SOURCES bench/jacket/bench_jacket.cpp DEPS passive_jacket passive_rendering passive_safety)
telehug_bench(bench_pins
  SOURCES bench/pins/bench_pins.cpp bench/pins/set_log.cpp bench/pins/touching_peer.cpp doubles/wire_between.cpp
  DEPS passive_link running_pair telehug_dds telehug_peer)
telehug_bench(bench_resources SOURCES bench/resources/bench_resources.cpp
  DEPS running_pair telehug_pictures opencv::imgproc PkgConfig::xcb)
