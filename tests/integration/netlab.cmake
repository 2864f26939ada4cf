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

# They measure how long real processes take: with sanitizers nothing, beside other tests those; hence they come last
# (quiet_tests).
if(NOT TELEHUG_SANITIZER)
  # The wall clock of a program under test (LD_PRELOAD).
  add_library(wall_clock_shim MODULE wall_clock/shim.cpp)
  telehug_settings(wall_clock_shim)

  # A peer that no daemon would be.
  telehug_program(purpose-made-sender SOURCES integration/link_faults/purpose_made_sender.cpp
    DEPS telehug_dds telehug_idl telehug_pairing telehug_peer CLI11::CLI11 USES_FASTDDS)
  set_target_properties(purpose-made-sender PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)

  add_library(faulty_link STATIC integration/link_faults/faulty_link.cpp integration/link_faults/fault_table.cpp)
  target_include_directories(faulty_link PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(faulty_link PUBLIC running_pair netlab)
  target_compile_definitions(faulty_link PRIVATE TELEHUG_FIXTURES="${PROJECT_SOURCE_DIR}/tests/fixtures"
    PUBLIC TELEHUG_WALL_CLOCK_SHIM="$<TARGET_FILE:wall_clock_shim>"
    TELEHUG_PURPOSE_MADE_SENDER="$<TARGET_FILE:purpose-made-sender>")
  add_dependencies(faulty_link wall_clock_shim purpose-made-sender)
  telehug_settings(faulty_link)

  telehug_test(test_link_faults KIND integration SUBJECT link
    SOURCES integration/link_faults/link_faults_test.cpp DEPS faulty_link)
  telehug_test(test_jacket_faults KIND integration SUBJECT jacket
    SOURCES integration/link_faults/jacket_faults_test.cpp doubles/wire_between.cpp
    DEPS faulty_link passive_jacket passive_link)
  telehug_test(test_wireguard KIND integration SUBJECT link
    SOURCES integration/ways/wireguard_test.cpp DEPS faulty_link)
  telehug_test(test_link_changes KIND integration SUBJECT link
    SOURCES integration/link_faults/link_changes_test.cpp
    DEPS faulty_link telehug_pairing OpenSSL::Crypto nlohmann_json::nlohmann_json TIMEOUT 1800)
  telehug_test(test_pairing_between_homes KIND integration SUBJECT link
    SOURCES integration/link_faults/pairing_between_homes_test.cpp DEPS faulty_link telehug_pairing_link)
  telehug_test(test_refusals KIND integration SUBJECT link
    SOURCES integration/link_faults/refusals_test.cpp
    DEPS faulty_link telehug_pairing OpenSSL::Crypto nlohmann_json::nlohmann_json)
  telehug_test(test_forgery KIND integration SUBJECT link
    SOURCES integration/link_faults/forgery_test.cpp
    DEPS faulty_link telehug_dds telehug_idl USES_FASTDDS)
  set(quiet_tests test_forgery test_link_changes test_link_faults test_pairing_between_homes test_refusals
    test_wireguard test_jacket_faults)
endif()
