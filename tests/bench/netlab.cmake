# SPDX-License-Identifier: Apache-2.0
# libmosquitto (EPL-2.0 or EDL-1.0) is only what the benchmark compares with.
pkg_check_modules(mosquitto REQUIRED IMPORTED_TARGET libmosquitto)
telehug_bench(bench_homes USES_FASTDDS
  SOURCES bench/homes/arrival_log.cpp bench/homes/bench_homes.cpp bench/homes/broker.cpp bench/homes/event_codec.cpp
          bench/homes/exchange.cpp bench/homes/link_figures.cpp bench/homes/mqtt_way.cpp bench/homes/report.cpp
          bench/homes/roles.cpp bench/homes/secured_way.cpp bench/homes/udp_way.cpp
  DEPS active_publish netlab passive_subscribe telehug_dds telehug_idl telehug_pairing telehug_peer
       PkgConfig::mosquitto)
# Whether all three ways deliver; how fast is nobody's to assert.
if(NOT TELEHUG_SANITIZER)
  add_test(NAME test_bench_homes COMMAND bench_homes --smoke --rounds 1 --seconds 1 --cpu-seconds 1)
  set_tests_properties(test_bench_homes PROPERTIES LABELS "integration;link" TIMEOUT 300 SKIP_RETURN_CODE 77)
endif()

telehug_bench(bench_pairs SOURCES bench/pairs/bench_pairs.cpp
  DEPS netlab telehug_dds telehug_pairing telehug_peer telehug_peer_link)
