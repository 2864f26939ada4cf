# SPDX-License-Identifier: Apache-2.0
# The pages against the repository and the programs. They say nothing that a sanitizer could judge.
if(NOT TELEHUG_SANITIZER)
  foreach(what links facts commands)
    add_test(NAME test_docs_${what} COMMAND ${CMAKE_COMMAND} -E env TELEHUG_BIN=${CMAKE_RUNTIME_OUTPUT_DIRECTORY}
      /usr/bin/python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/integration/docs/${what}_test.py)
    set_tests_properties(test_docs_${what} PROPERTIES LABELS "integration;ops" TIMEOUT 300)
  endforeach()
endif()
