# SPDX-License-Identifier: Apache-2.0
telehug_test(test_active_pipeline KIND pipeline SUBJECT touch
  SOURCES doubles/allocation_counter.cpp pipeline/app/active_pipeline_test.cpp pipeline/app/watched_camera_test.cpp
  DEPS active_app)
telehug_test(test_calibrate_by_hand KIND pipeline SUBJECT touch SOURCES pipeline/app/calibrate_by_hand_test.cpp
  DEPS active_app)
telehug_test(test_passive_pipeline KIND pipeline SUBJECT jacket
  SOURCES
    doubles/allocation_counter.cpp
    pipeline/app/passive_pipeline_consent_test.cpp
    pipeline/app/passive_pipeline_places_test.cpp
    pipeline/app/passive_pipeline_senders_test.cpp
    pipeline/app/passive_pipeline_test.cpp
  DEPS passive_app)
