# SPDX-License-Identifier: Apache-2.0
telehug_test(test_peer KIND unit SUBJECT link
  SOURCES unit/peer/heard_hugs_test.cpp unit/peer/heartbeat_test.cpp unit/peer/session_test.cpp
  DEPS telehug_peer)

telehug_test(test_link_supervisor KIND unit SUBJECT link
  SOURCES unit/peer/link_supervisor_test.cpp
  DEPS telehug_peer)

telehug_test(test_suspend_detector KIND unit SUBJECT link
  SOURCES unit/network/suspend_detector_test.cpp
  DEPS telehug_network)

telehug_test(test_ways_in KIND unit SUBJECT link
  SOURCES unit/network/ways_in_test.cpp
  DEPS telehug_network)

telehug_test(test_publish KIND unit SUBJECT link
  SOURCES unit/publish/hug_player_test.cpp unit/publish/touch_event_builder_test.cpp unit/publish/touch_stream_test.cpp
    doubles/allocation_counter.cpp
  DEPS active_publish telehug_dds)

telehug_test(test_subscribe KIND unit SUBJECT link
  SOURCES unit/subscribe/lossy_way_test.cpp unit/subscribe/sender_turn_test.cpp unit/subscribe/staleness_test.cpp unit/subscribe/touch_order_test.cpp
  DEPS passive_subscribe active_publish)

telehug_test(test_dds KIND unit SUBJECT link
  SOURCES unit/dds/library_log_test.cpp unit/dds/malformed_payload_test.cpp unit/dds/message_filter_test.cpp unit/dds/strangers_test.cpp unit/dds/validate_test.cpp unit/dds/wire_test.cpp
  DEPS telehug_dds telehug_idl
  USES_FASTDDS)

telehug_test(test_peer_link KIND unit SUBJECT link
  SOURCES unit/peer_link/stop_latch_test.cpp
  DEPS telehug_peer_link)

telehug_test(test_pairing KIND unit SUBJECT link
  SOURCES unit/pairing/pair_store_test.cpp unit/pairing/renewal_test.cpp unit/pairing/wireguard_test.cpp
  DEPS telehug_pairing nlohmann_json::nlohmann_json OpenSSL::Crypto)

telehug_test(test_pairing_link KIND unit SUBJECT link
  SOURCES unit/pairing_link/pairing_code_test.cpp unit/pairing_link/pairing_exchange_test.cpp
  DEPS telehug_pairing_link OpenSSL::SSL)

telehug_test(test_qr_code KIND unit SUBJECT link
  SOURCES unit/pairing_link/qr_code_test.cpp
  DEPS telehug_pairing_link PkgConfig::zxing)

telehug_test(test_membership KIND unit SUBJECT link
  SOURCES unit/daemon/config_reload_test.cpp unit/daemon/connections_test.cpp unit/daemon/hug_request_test.cpp unit/daemon/membership_test.cpp unit/daemon/metric_table_test.cpp
          unit/daemon/pairing_run_test.cpp
  DEPS telehug_daemon)

telehug_test(test_kept_stop KIND unit SUBJECT ops
  SOURCES unit/daemon/kept_stop_test.cpp
  DEPS telehug_daemon)

telehug_test(test_link_keeper KIND unit SUBJECT link
  SOURCES unit/daemon/link_keeper_test.cpp
  DEPS telehug_daemon
  USES_FASTDDS)

telehug_test(test_link_figures KIND unit SUBJECT link
  SOURCES unit/bench/link_figures_test.cpp bench/homes/link_figures.cpp
  DEPS active_publish)

telehug_test(test_peer_absence KIND unit SUBJECT link
  SOURCES unit/daemon/peer_absence_test.cpp
  DEPS telehug_daemon)
