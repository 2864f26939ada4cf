# SPDX-License-Identifier: Apache-2.0
telehug_test(test_serial_link KIND integration SUBJECT jacket
  SOURCES integration/link/serial_link_test.cpp
  DEPS passive_link)
add_dependencies(test_serial_link telehug-jacket-sim)

telehug_test(test_jacket_boards KIND integration SUBJECT jacket
  SOURCES integration/link/jacket_boards_test.cpp
  DEPS passive_link)
add_dependencies(test_jacket_boards telehug-jacket-sim)
telehug_test(test_bluez KIND integration SUBJECT jacket
  SOURCES integration/wire/bluez_test.cpp doubles/fake_bluez.cpp
  DEPS passive_link PkgConfig::sdbus)
# The real avrdude and real bootloaders; libsimavr is under the GPL, as everything that links it a program of its own.
telehug_test(test_jacket_flash KIND integration SUBJECT jacket
  SOURCES integration/ctl/jacket_flash_test.cpp integration/ctl/simulated_board.cpp
  DEPS passive_link telehug_service jacket_simulator ${SIMAVR_LIBRARY})
target_include_directories(test_jacket_flash SYSTEM PRIVATE ${SIMAVR_INCLUDE_DIR})
target_compile_definitions(test_jacket_flash PRIVATE TELEHUG_FIRMWARE_FOLDER="${TELEHUG_BUILT_DATA}/firmware")
add_dependencies(test_jacket_flash telehug telehug_jacket_firmware)
