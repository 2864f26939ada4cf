# SPDX-License-Identifier: Apache-2.0
telehug_test(test_common KIND unit SUBJECT ops
  SOURCES unit/common/latest_slot_test.cpp unit/common/outside_json_test.cpp unit/common/result_test.cpp
  DEPS telehug_common)
