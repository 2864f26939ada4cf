# SPDX-License-Identifier: Apache-2.0
#
# Two homes with a network that fails on command between them. They need the right to make network namespaces (root),
# and are skipped without it.
add_library(netlab STATIC netlab/captured_packet.cpp netlab/ethernet_port.cpp netlab/faulty_way.cpp
  netlab/hidden_pc.cpp netlab/net_namespace.cpp netlab/packet_mangler.cpp netlab/pcap_file.cpp
  netlab/recorded_loopback.cpp netlab/run_inside.cpp netlab/two_homes.cpp netlab/wireguard_tunnel.cpp)
target_include_directories(netlab PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(netlab PUBLIC telehug_common)
telehug_settings(netlab)

telehug_test(test_netlab KIND integration SUBJECT link SOURCES integration/netlab/two_homes_test.cpp DEPS netlab)

telehug_test(test_forwarded_ports KIND integration SUBJECT link
  SOURCES integration/ways/forwarded_ports_test.cpp
  DEPS running_pair netlab telehug_dds)

# It measures how long real processes take: beside other tests it would measure those, with sanitizers nothing.
if(NOT TELEHUG_SANITIZER)
  telehug_test(test_link_faults KIND integration SUBJECT link
    SOURCES integration/link_faults/link_faults_test.cpp integration/link_faults/faulty_link.cpp
            integration/link_faults/fault_table.cpp
    DEPS running_pair netlab)
  telehug_test(test_wireguard KIND integration SUBJECT link
    SOURCES integration/ways/wireguard_test.cpp integration/link_faults/faulty_link.cpp
            integration/link_faults/fault_table.cpp
    DEPS running_pair netlab)
  set_tests_properties(test_link_faults test_wireguard PROPERTIES RUN_SERIAL TRUE)
endif()
