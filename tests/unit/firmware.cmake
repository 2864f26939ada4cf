# SPDX-License-Identifier: Apache-2.0
# GCC 12 with -D_FORTIFY_SOURCE takes Boost's static_vector of a braced list for uninitialised.
set_source_files_properties(unit/link/frame_codec_test.cpp PROPERTIES COMPILE_OPTIONS
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
telehug_test(test_link KIND unit SUBJECT jacket
  SOURCES
    unit/link/frame_codec_test.cpp
    unit/link/jacket_session_heat_test.cpp
    unit/link/jacket_session_test.cpp
    unit/link/jacket_telemetry_test.cpp
    unit/link/legacy_session_test.cpp
    unit/link/make_link_test.cpp
    unit/link/wire_link_test.cpp
    doubles/allocation_counter.cpp
  DEPS passive_link)

telehug_test(test_wire KIND unit SUBJECT jacket
  SOURCES
    unit/wire/rfcomm_opener_test.cpp
    unit/wire/rfcomm_peer_test.cpp
    unit/wire/serial_port_test.cpp
    unit/wire/wire_test.cpp
    doubles/ioctl_double.cpp
  DEPS passive_wire)

telehug_test(test_firmware KIND unit SUBJECT jacket
  SOURCES
    unit/firmware/both_ends_test.cpp
    unit/firmware/conversation_test.cpp
    unit/firmware/drives_test.cpp
    unit/firmware/figures_test.cpp
    unit/firmware/legacy_test.cpp
    unit/firmware/pin_activity_test.cpp
    unit/firmware/simulated_heaters_test.cpp
    unit/firmware/wire_faults_test.cpp
  DEPS passive_link jacket_simulator fmt::fmt)

# Half an hour of the microcontroller's time.
telehug_test(test_firmware_heaters KIND unit SUBJECT jacket TIMEOUT 1800
  SOURCES
    unit/firmware/heater_faults_test.cpp
    unit/firmware/heating_test.cpp
    unit/firmware/off_times_test.cpp
  DEPS passive_link jacket_simulator fmt::fmt)

foreach(test test_firmware test_firmware_heaters)
  target_compile_definitions(${test} PRIVATE
    TELEHUG_FIRMWARE_ELF="${CMAKE_BINARY_DIR}/firmware/telehug-jacket.elf"
    TELEHUG_FIRMWARE_FOLDER="${CMAKE_BINARY_DIR}/firmware")
  add_dependencies(${test} telehug_jacket_firmware)
endforeach()

telehug_test(test_udev_rules KIND unit SUBJECT jacket SOURCES unit/deploy/udev_rules_test.cpp DEPS telehug_common)
