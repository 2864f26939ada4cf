# SPDX-License-Identifier: Apache-2.0
telehug_test(test_web_server KIND integration SUBJECT web
  SOURCES integration/web/web_server_test.cpp integration/web/web_streams_test.cpp integration/web/daemon_pages_test.cpp
    doubles/allocation_counter.cpp
  DEPS telehug_web fmt::fmt)
