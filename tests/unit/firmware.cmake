# SPDX-License-Identifier: Apache-2.0
telehug_test(test_link KIND unit SUBJECT jacket
  SOURCES
    unit/link/frame_codec_test.cpp
    unit/link/jacket_session_heat_test.cpp
    unit/link/jacket_session_test.cpp
    unit/link/jacket_telemetry_test.cpp
    unit/link/make_link_test.cpp
  DEPS passive_link)

telehug_test(test_firmware KIND unit SUBJECT jacket
  SOURCES unit/firmware/both_ends_test.cpp unit/firmware/conversation_test.cpp unit/firmware/drives_test.cpp unit/firmware/pin_activity_test.cpp
  DEPS passive_link jacket_simulator)
target_compile_definitions(test_firmware PRIVATE TELEHUG_FIRMWARE_ELF="${CMAKE_BINARY_DIR}/firmware/telehug-jacket.elf")
add_dependencies(test_firmware telehug_jacket_firmware)
