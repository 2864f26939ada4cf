# SPDX-License-Identifier: Apache-2.0
#
# Two homes with a network that fails on command between them. They need the right to make network namespaces (root),
# and are skipped without it.
add_library(netlab STATIC netlab/captured_packet.cpp netlab/ethernet_port.cpp netlab/faulty_way.cpp
  netlab/net_namespace.cpp netlab/two_homes.cpp)
target_include_directories(netlab PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(netlab PUBLIC telehug_common)
telehug_settings(netlab)

telehug_test(test_netlab KIND integration SUBJECT link SOURCES integration/netlab/two_homes_test.cpp DEPS netlab)
