# SPDX-License-Identifier: Apache-2.0
telehug_test(test_local_outputs KIND integration SUBJECT touch
  SOURCES integration/local_touch/local_touch_test.cpp integration/local_touch/real_touchscreen_test.cpp
          integration/local_touch/tuio_sender_test.cpp
  DEPS active_local_touch PkgConfig::libevdev PkgConfig::liblo)
