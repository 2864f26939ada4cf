# SPDX-License-Identifier: Apache-2.0

# telehug_web_files(TARGET FUNCTION FOLDER)
# Embeds every file below FOLDER (of this source folder) into TARGET. FUNCTION, declared as
# `std::span<const telehug::EmbeddedFile> FUNCTION()` in the namespace telehug, returns them by their names there.
function(telehug_web_files target function folder)
  set(root ${CMAKE_CURRENT_SOURCE_DIR}/${folder})
  file(GLOB_RECURSE files RELATIVE ${root} CONFIGURE_DEPENDS ${root}/*.html ${root}/*.css ${root}/*.js ${root}/*.json
    ${root}/*.svg ${root}/*.png)
  list(SORT files)
  set(assembly)
  set(symbols)
  set(rows)
  set(paths)
  set(number 0)
  foreach(file ${files})
    set(symbol ${function}_${number})
    string(APPEND assembly "${symbol}: .incbin \\\"${root}/${file}\\\"\\n${symbol}_end:\\n")
    string(APPEND symbols "extern \"C\" [[gnu::visibility(\"hidden\")]] const char ${symbol}[], ${symbol}_end[];\n")
    string(APPEND rows "    {\"${file}\", {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})}},\n")
    list(APPEND paths ${root}/${file})
    math(EXPR number "${number} + 1")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded_${function}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
// Made by cmake/WebFiles.cmake.
#include <cstddef>
#include <span>

#include "web/web_files.hpp"

asm(".section .rodata\n@assembly@.previous");
@symbols@
namespace telehug {
std::span<const EmbeddedFile> @function@();
std::span<const EmbeddedFile> @function@() {
  static const EmbeddedFile files[] = {
@rows@  };
  return files;
}
}  // namespace telehug
]])
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${paths}")
  target_sources(${target} PRIVATE ${source})
endfunction()
