# SPDX-License-Identifier: Apache-2.0
telehug_test(test_rendering KIND unit SUBJECT jacket
  SOURCES
    bench/rendering/accuracy.cpp
    bench/rendering/accuracy_picture.cpp
    unit/rendering/accuracy_test.cpp
    unit/rendering/box_rendering_test.cpp
    unit/rendering/drive_shaper_test.cpp
    unit/rendering/feel_test.cpp
    unit/rendering/felt_path_test.cpp
    unit/rendering/motor_mesh_test.cpp
    unit/rendering/place_rendering_test.cpp
    unit/rendering/rendering_golden_test.cpp
    unit/rendering/rendering_property_test.cpp
    unit/rendering/stroke_rendering_test.cpp
  DEPS passive_jacket passive_rendering passive_safety fmt::fmt)
