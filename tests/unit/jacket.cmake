# SPDX-License-Identifier: Apache-2.0
telehug_test(test_jacket KIND unit SUBJECT jacket
  SOURCES
    unit/jacket/body_picture_test.cpp
    unit/jacket/body_svg_test.cpp
    unit/jacket/duemilanove_12_heaters_2_test.cpp
    unit/jacket/duemilanove_16_test.cpp
    unit/jacket/intensity_test.cpp
    unit/jacket/jacket_overrides_test.cpp
    unit/jacket/jacket_profile_test.cpp
    unit/jacket/legacy_16_test.cpp
    unit/jacket/ring_1_test.cpp
    unit/jacket/safety_property_test.cpp
    unit/jacket/safety_stage_test.cpp
    unit/jacket/several_senders_test.cpp
  DEPS active_feedback passive_jacket passive_link passive_rendering passive_safety fmt::fmt)

# Do the JSON schema and the loader take the same files for right?
add_test(NAME test_jacket_schema COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/unit/jacket/schema_test.py
  $<TARGET_FILE:telehug-passive> ${PROJECT_SOURCE_DIR}/deploy/jackets)
set_tests_properties(test_jacket_schema PROPERTIES LABELS "unit;jacket" TIMEOUT 120)

telehug_test(test_safety KIND unit SUBJECT jacket
  SOURCES unit/safety/consent_test.cpp unit/safety/current_budget_test.cpp unit/safety/duty_budget_test.cpp
          unit/safety/heater_supervision_test.cpp unit/safety/muted_place_test.cpp
          unit/safety/stage_budgets_test.cpp unit/safety/stage_consent_test.cpp unit/safety/stage_heaters_test.cpp
  DEPS passive_safety)
