# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_face
  SOURCES bench/body_map/bench_face.cpp bench/body_map/face_figures.cpp bench/body_map/screen_figures.cpp
          bench/touch/drawn_touches.cpp bench/touch/print_figures.cpp doubles/allocation_counter.cpp
  DEPS active_app active_body_map active_calibration active_capture active_detection active_finger active_touch
       telehug_pictures opencv::imgproc PkgConfig::xcb)
