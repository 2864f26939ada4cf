# SPDX-License-Identifier: Apache-2.0
telehug_test(test_jacket KIND unit SUBJECT jacket
  SOURCES
    unit/jacket/body_picture_test.cpp
    unit/jacket/duemilanove_16_test.cpp
    unit/jacket/intensity_test.cpp
    unit/jacket/jacket_profile_test.cpp
    unit/jacket/safety_property_test.cpp
    unit/jacket/safety_stage_test.cpp
    unit/jacket/several_senders_test.cpp
  DEPS passive_jacket passive_rendering passive_safety fmt::fmt)
