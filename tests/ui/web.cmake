# SPDX-License-Identifier: Apache-2.0
# The pages in Debian's Chromium, on real daemons. Node's packages come from npm, by the lock file; screenshots lie in
# ui/pictures of the build folder afterwards. With sanitizers it would be a test of patience.
if(NOT TELEHUG_SANITIZER)
  add_test(NAME ui_packages COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/ui/pages/install ${CMAKE_BINARY_DIR}/ui/packages)
  set_tests_properties(ui_packages PROPERTIES LABELS "ui;web" TIMEOUT 120 FIXTURES_SETUP ui_packages)
  foreach(page
      accuracy
      body
      draw
      live
      pairing
      setup
      setup_camera
      touch)
    add_test(NAME test_${page}_page COMMAND node --test ${CMAKE_CURRENT_SOURCE_DIR}/ui/pages/${page}_test.js)
    set_tests_properties(test_${page}_page PROPERTIES
      LABELS "ui;web" TIMEOUT 120 FIXTURES_REQUIRED ui_packages PROCESSORS 2
      ENVIRONMENT "TELEHUG_BIN=${CMAKE_RUNTIME_OUTPUT_DIRECTORY};TELEHUG_SOURCE=${PROJECT_SOURCE_DIR};TELEHUG_UI_PACKAGES=${CMAKE_BINARY_DIR}/ui/packages;TELEHUG_UI_PICTURES=${CMAKE_BINARY_DIR}/ui/pictures")
  endforeach()
  set_tests_properties(test_setup_page PROPERTIES TIMEOUT 240)  # a person's whole set-up, in real time
endif()
