# SPDX-License-Identifier: Apache-2.0
telehug_test(test_web KIND unit SUBJECT web
  SOURCES unit/web/entrance_test.cpp unit/web/live_topics_test.cpp unit/web/request_rules_test.cpp
          unit/web/texts_test.cpp unit/web/web_files_test.cpp unit/web/web_site_test.cpp
  DEPS telehug_web)
