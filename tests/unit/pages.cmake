# SPDX-License-Identifier: Apache-2.0
# Modules of the pages that need no browser.
foreach(modules drawing accuracy)
  add_test(NAME test_${modules}_modules COMMAND node --test ${CMAKE_CURRENT_SOURCE_DIR}/unit/pages/${modules}_test.js)
  set_tests_properties(test_${modules}_modules PROPERTIES LABELS "unit;web" TIMEOUT 30)
endforeach()
