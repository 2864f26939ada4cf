# SPDX-License-Identifier: Apache-2.0
#
# A room is one folder of the house and one static library. Its headers are included as "room/header.hpp", and that
# path exists only for targets that name the room in DEPS: each room has an include root of its own, holding nothing
# but a link to its folder. An include across an arrow that CMake does not know therefore does not compile.
#
# Fast DDS lies in the compiler's default include path and can't be hidden like that; outside the rooms that may use it
# (USES_FASTDDS) its namespace is poisoned, so that its headers do not compile either.

set(TELEHUG_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    -Wold-style-cast -Woverloaded-virtual -Wduplicated-cond -Wlogical-op -Werror)

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

function(telehug_settings target)
  # The warnings are g++'s; fuzzers and the address sanitizer's build are clang's, which lacks some of them.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE ${TELEHUG_WARNINGS})
    if(TELEHUG_SANITIZER)
      # GCC's manual: instrumented code makes these warnings err; the other builds keep them.
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized -Wno-stringop-overflow)
    endif()
    if(TELEHUG_SANITIZER STREQUAL thread)
      target_compile_options(${target} PRIVATE -Wno-tsan)  # Asio's fences, which it does not know
    endif()
  endif()
  if(NOT ARGN STREQUAL "USES_FASTDDS")
    target_compile_options(${target} PRIVATE -include ${PROJECT_SOURCE_DIR}/cmake/no_fastdds.hpp)
  endif()
endfunction()

# telehug_room(TARGET ROOM SOURCES file... [DEPS target...] [PRIVATE_DEPS target...] [USES_FASTDDS])
function(telehug_room target room)
  cmake_parse_arguments(arg "USES_FASTDDS" "" "SOURCES;DEPS;PRIVATE_DEPS" ${ARGN})
  set(include_root ${CMAKE_BINARY_DIR}/rooms/${target})
  file(MAKE_DIRECTORY ${include_root})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/${room} SYMBOLIC)
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    target_include_directories(${target} PUBLIC ${include_root})
    target_link_libraries(${target} PUBLIC ${arg_DEPS} PRIVATE ${arg_PRIVATE_DEPS})
    if(arg_USES_FASTDDS)
      telehug_settings(${target} USES_FASTDDS)
    else()
      telehug_settings(${target})
    endif()
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${include_root})
    target_link_libraries(${target} INTERFACE ${arg_DEPS})
  endif()
endfunction()

# telehug_values(TARGET ROOM HEADERS file... [DEPS target...])
# The plain value headers of a room, for the stages that consume them: nothing else of the room is reachable this way.
function(telehug_values target room)
  cmake_parse_arguments(arg "" "" "HEADERS;DEPS" ${ARGN})
  set(include_root ${CMAKE_BINARY_DIR}/rooms/${target})
  file(MAKE_DIRECTORY ${include_root}/${room})
  foreach(header ${arg_HEADERS})
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${header} ${include_root}/${room}/${header} SYMBOLIC)
  endforeach()
  add_library(${target} INTERFACE)
  target_include_directories(${target} INTERFACE ${include_root})
  target_link_libraries(${target} INTERFACE ${arg_DEPS})
endfunction()

# telehug_program(NAME SOURCES file... DEPS target... [USES_FASTDDS])
function(telehug_program target)
  cmake_parse_arguments(arg "USES_FASTDDS" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE ${arg_DEPS})
  if(arg_USES_FASTDDS)
    telehug_settings(${target} USES_FASTDDS)
  else()
    telehug_settings(${target})
  endif()
endfunction()
