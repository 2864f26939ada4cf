# SPDX-License-Identifier: Apache-2.0
#
# telehug's wire against somebody else's implementations: programs on Cyclone DDS (EPL-2.0 or EDL-1.0; nothing but these
# test programs is linked with it), and tshark, which runs as it is.
telehug_test(test_on_the_wire KIND integration SUBJECT link
  SOURCES interop/on_the_wire_test.cpp interop/dissection.cpp
  DEPS running_pair netlab fmt::fmt)

# Building without the packages of the tests is possible, as deploy/demo does.
find_package(CycloneDDS QUIET)
find_program(IDLC idlc)
if(NOT CycloneDDS_FOUND OR NOT IDLC)
  message(STATUS "Without Cyclone DDS its tests are not built: run `deploy/setup test`")
  return()
endif()

# interop_program(NAME IDL): interop/cyclone/NAME.c with the types of the IDL file.
function(interop_program name idl)
  get_filename_component(types ${idl} NAME_WE)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/interop/generated_${name})
  file(MAKE_DIRECTORY ${generated})
  add_custom_command(OUTPUT ${generated}/${types}.c ${generated}/${types}.h
    COMMAND ${IDLC} -f case-sensitive -o ${generated} ${idl}
    DEPENDS ${idl} VERBATIM COMMENT "Generating Cyclone DDS' types from ${types}.idl")
  # Generated code is not held to telehug's warnings, as in idl/.
  add_library(${name}_types STATIC ${generated}/${types}.c)
  target_include_directories(${name}_types SYSTEM PUBLIC ${generated})
  target_link_libraries(${name}_types PUBLIC CycloneDDS::ddsc)
  add_executable(${name} interop/cyclone/${name}.c)
  target_link_libraries(${name} PRIVATE ${name}_types)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Werror)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/interop)
endfunction()
interop_program(wearer_side ${PROJECT_SOURCE_DIR}/idl/telehug.idl)
interop_program(another_version ${CMAKE_CURRENT_SOURCE_DIR}/interop/cyclone/another_version.idl)

telehug_test(test_cyclone_interop KIND integration SUBJECT link
  SOURCES interop/cyclone_test.cpp
  DEPS telehug_dds telehug_peer nlohmann_json::nlohmann_json)
telehug_test(test_cyclone_wearer KIND integration SUBJECT link
  SOURCES interop/daemon_test.cpp
  DEPS running_pair)
foreach(test test_cyclone_interop test_cyclone_wearer)
  add_dependencies(${test} wearer_side another_version)
  target_compile_definitions(${test} PRIVATE TELEHUG_INTEROP_BIN="${CMAKE_BINARY_DIR}/tests/interop")
endforeach()
