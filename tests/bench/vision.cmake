# SPDX-License-Identifier: Apache-2.0
telehug_bench(bench_touch
  SOURCES bench/touch/bench_touch.cpp bench/touch/default_figures.cpp bench/touch/detector_stages.cpp
          bench/touch/drawn_touches.cpp bench/touch/print_figures.cpp
          bench/touch/mjpeg_figures.cpp bench/touch/thesis_figures.cpp doubles/allocation_counter.cpp
  DEPS active_app active_calibration active_capture active_detection active_eval active_finger active_touch
       telehug_pictures PkgConfig::libjpeg)
telehug_bench(bench_setup SOURCES bench/setup/bench_setup.cpp doubles/random_set_up.cpp
  DEPS active_setup active_capture opencv::imgproc telehug_pictures)
