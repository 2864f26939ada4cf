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
telehug_fuzzer(frame SUBJECT jacket DEPS passive_link)
telehug_fuzzer(config SUBJECT ops DEPS telehug_config)
