# SPDX-License-Identifier: Apache-2.0

# telehug_fuzzer(NAME SUBJECT link|jacket|ops DEPS target... [USES_FASTDDS])
# fuzz/fuzz_NAME.cpp with the inputs in fuzz/corpus/NAME: a test that replays these, and with the preset `fuzz` the
# libFuzzer program itself.
function(telehug_fuzzer name)
  cmake_parse_arguments(arg "USES_FASTDDS" "SUBJECT" "DEPS" ${ARGN})
  set(fastdds)
  if(arg_USES_FASTDDS)
    set(fastdds USES_FASTDDS)
  endif()
  telehug_test(test_corpus_${name} KIND unit SUBJECT ${arg_SUBJECT}
    SOURCES fuzz/corpus_test.cpp fuzz/fuzz_${name}.cpp
    DEPS ${arg_DEPS} ${fastdds})
  target_compile_definitions(test_corpus_${name} PRIVATE
    TELEHUG_CORPUS="${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${name}")
  if(TELEHUG_FUZZ)
    add_executable(fuzz_${name} fuzz/fuzz_${name}.cpp)
    target_include_directories(fuzz_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(fuzz_${name} PRIVATE ${arg_DEPS})
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    set_target_properties(fuzz_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz)
    add_dependencies(fuzzers fuzz_${name})
  endif()
endfunction()

if(TELEHUG_FUZZ)
  add_custom_target(fuzzers)
endif()
telehug_fuzzer(dds SUBJECT link DEPS telehug_dds telehug_idl USES_FASTDDS)
telehug_fuzzer(message SUBJECT link DEPS telehug_dds USES_FASTDDS)
telehug_fuzzer(frame SUBJECT jacket DEPS passive_link)
telehug_fuzzer(config SUBJECT ops DEPS telehug_config)
telehug_fuzzer(jacket_session SUBJECT jacket DEPS passive_link)
telehug_fuzzer(jacket_profile SUBJECT jacket DEPS passive_jacket passive_rendering passive_safety)
telehug_fuzzer(peer SUBJECT link DEPS passive_app)
telehug_fuzzer(pairing_code SUBJECT link DEPS telehug_pairing_link)
telehug_fuzzer(pairing_dialogue SUBJECT link DEPS telehug_pairing_link OpenSSL::SSL)
telehug_fuzzer(pairing_texts SUBJECT link DEPS telehug_pairing nlohmann_json::nlohmann_json OpenSSL::Crypto)
telehug_fuzzer(pair_files SUBJECT link DEPS telehug_daemon OpenSSL::Crypto)
telehug_fuzzer(control SUBJECT ops DEPS telehug_ctl telehug_daemon)
telehug_fuzzer(web SUBJECT web DEPS telehug_web fmt::fmt)
telehug_fuzzer(picture SUBJECT touch DEPS telehug_pictures)
telehug_fuzzer(edid SUBJECT touch DEPS active_screen_x11)
telehug_fuzzer(calibration SUBJECT touch DEPS active_calibration)
telehug_fuzzer(rig_files SUBJECT touch DEPS active_capture active_finger)

# The firmware's session between doubles, without the warnings that are the host's (its numbers are 8 bits wide).
add_library(firmware_session_on_host STATIC
  ${PROJECT_SOURCE_DIR}/passive_side/firmware/session.cpp doubles/firmware_board.cpp)
target_include_directories(firmware_session_on_host PUBLIC ${PROJECT_SOURCE_DIR}/tests
  PRIVATE ${PROJECT_SOURCE_DIR}/tests/doubles/avr PUBLIC ${PROJECT_SOURCE_DIR}/passive_side/firmware
  ${PROJECT_SOURCE_DIR}/passive_side)
target_compile_definitions(firmware_session_on_host PRIVATE TELEHUG_BOARD="boards/motors12_heaters2.hpp"
  TELEHUG_FIRMWARE_VERSION=2)
telehug_fuzzer(firmware_session SUBJECT jacket DEPS firmware_session_on_host passive_link)
