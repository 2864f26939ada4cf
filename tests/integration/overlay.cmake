# SPDX-License-Identifier: Apache-2.0
telehug_test(test_x11_overlay KIND integration SUBJECT face
  SOURCES integration/overlay/x11_hotkey_test.cpp integration/overlay/x11_overlay_test.cpp
  DEPS active_overlay PkgConfig::xtest)
