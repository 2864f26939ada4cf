# SPDX-License-Identifier: Apache-2.0
telehug_test(test_config KIND unit SUBJECT ops
  SOURCES unit/config/config_report_test.cpp unit/config/faults_test.cpp unit/config/layers_test.cpp unit/config/locator_test.cpp unit/config/places_test.cpp
          unit/config/quiet_hours_text_test.cpp
          unit/config/random_bytes_test.cpp unit/config/reload_test.cpp unit/config/shipped_file_test.cpp
  DEPS telehug_config)

telehug_test(test_service KIND unit SUBJECT ops
  SOURCES unit/service/log_test.cpp unit/service/metrics_test.cpp unit/service/notifier_test.cpp
          unit/service/open_metrics_test.cpp
          unit/service/signals_test.cpp
  DEPS telehug_service)

telehug_test(test_ctl KIND unit SUBJECT ops
  SOURCES unit/ctl/avrdude_output_test.cpp unit/ctl/doctor_checks_test.cpp unit/ctl/fuses_test.cpp unit/ctl/masker_test.cpp unit/ctl/pair_place_test.cpp unit/ctl/run_program_test.cpp
          unit/ctl/status_text_test.cpp unit/ctl/watch_text_test.cpp
  DEPS telehug_ctl)

telehug_test(test_cli KIND unit SUBJECT ops
  SOURCES unit/cli/command_tree_test.cpp unit/cli/config_page_test.cpp unit/cli/exit_code_text_test.cpp
          unit/cli/man_page_test.cpp
  DEPS telehug_cli telehug_config telehug_manual CLI11::CLI11)
