# SPDX-License-Identifier: Apache-2.0
telehug_test(test_link KIND unit SUBJECT jacket
  SOURCES unit/link/frame_codec_test.cpp unit/link/jacket_session_test.cpp unit/link/make_link_test.cpp
  DEPS passive_link)

telehug_test(test_firmware KIND unit SUBJECT jacket
  SOURCES
    unit/firmware/both_ends_test.cpp
    unit/firmware/conversation_test.cpp
    unit/firmware/drives_test.cpp
    unit/firmware/figures_test.cpp
    unit/firmware/legacy_test.cpp
    unit/firmware/pin_activity_test.cpp
    unit/firmware/simulated_heaters_test.cpp
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
