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
