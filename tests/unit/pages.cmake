# SPDX-License-Identifier: Apache-2.0
# Modules of the pages that need no browser.
add_test(NAME test_drawing_modules COMMAND node --test ${CMAKE_CURRENT_SOURCE_DIR}/unit/pages/drawing_test.js)
set_tests_properties(test_drawing_modules PROPERTIES LABELS "unit;web" TIMEOUT 30)
