# SPDX-License-Identifier: Apache-2.0
telehug_test(test_export_rig KIND integration SUBJECT touch
  SOURCES integration/capture/export_rig_test.cpp
  DEPS active_capture)
