# SPDX-License-Identifier: Apache-2.0
# A real browser on an X server of its own and what telehug-active sees of it, in real time. With sanitizers it would be
# too slow to mean anything. The persons are those of the project, so that the verdict is the same everywhere; `--samples`
# measures others.
if(NOT TELEHUG_SANITIZER)
  add_test(NAME test_chat_in_a_browser
    COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/ui/screen/browser_test.py
      --telehug $<TARGET_FILE:telehug-active> --fixtures ${CMAKE_CURRENT_SOURCE_DIR}/fixtures)
  set_tests_properties(test_chat_in_a_browser PROPERTIES LABELS "ui;face" TIMEOUT 320 RUN_SERIAL TRUE)
endif()
