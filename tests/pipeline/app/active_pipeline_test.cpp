// SPDX-License-Identifier: Apache-2.0
//
// What is sent for the pictures that a camera delivers, and what for bad ones.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "doubles/allocation_counter.hpp"
#include "pipeline/app/active_pipeline_fixture.hpp"

namespace telehug {
namespace {

TEST_F(ActivePipelineTest, SendsTheBoxUnderTheFinger) {
  const TouchEvent* event = see(touching());
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->session, example_session);
  EXPECT_EQ(event->sequence, 1U);
  EXPECT_EQ(event->frame_time_ns, to_ns(frame.time));
  EXPECT_EQ(event->sent_time_ns, to_ns(clock.now()));
  EXPECT_EQ(event->body_map_version, 7U);
  ASSERT_EQ(event->contacts.size(), 1U);
  const Contact& contact = event->contacts[0];
  EXPECT_EQ(contact.phase, Phase::down);
  EXPECT_EQ(contact.box, 13);
  EXPECT_EQ(contact.grid, map.shape);
  EXPECT_NEAR(contact.screen.x_mm, 200, 3);
  EXPECT_NEAR(contact.screen.y_mm, 150, 6);
  EXPECT_NEAR(contact.body.x_fh, 0, 0.05);
  EXPECT_NEAR(contact.body.y_fh, 70 / 60.0, 0.1);
}

TEST_F(ActivePipelineTest, SendsTheBoxUnderTheFingerWithTheThesisDetector) {
  ActivePipeline thesis = pipeline_with(detector_of(calibration(), "thesis", nobody()));
  EXPECT_TRUE(thesis.knows_background()) << "it needs none";
  const TouchEvent* event = see_with(thesis, touching());
  ASSERT_NE(event, nullptr);
  ASSERT_EQ(event->contacts.size(), 1U);
  EXPECT_EQ(event->contacts[0].box, 13);
  EXPECT_NEAR(event->contacts[0].screen.x_mm, 200, 3);
  EXPECT_NEAR(event->contacts[0].screen.y_mm, 150, 6);
}

// A finger that closes the window in front of the chat, a cloth that cleans the screen.
TEST_F(ActivePipelineTest, SendsNoContactThatWasHeldBackUntilItIsLifted) {
  see_for(500ms, pipeline, touching());
  pipeline.hold_back_contacts();
  const TouchEvent* event = see_for(500ms, pipeline, touching());
  EXPECT_TRUE(event == nullptr || event->contacts.empty());
  see_for(1s, pipeline, nobody());
  event = see_for(500ms, pipeline, touching());
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.size(), 1U);
}

TEST_F(ActivePipelineTest, CountsAFingerOnceThatStaysInTheAirForLong) {
  ActivePipelineOptions doubtful = options();
  doubtful.tracker = {.down_above = 1.1};  // nothing touches for sure
  ActivePipeline hovering(calibration(), detector_of(calibration(), "default", nobody()), doubtful, stream, clock,
                          metrics);
  see_for(1400ms, hovering, touching());
  EXPECT_EQ(counter("fingers_hovered"), 0U);
  see_for(3s, hovering, touching());
  EXPECT_EQ(counter("fingers_hovered"), 1U);
  see_for(1s, hovering, nobody());
  see_for(2s, hovering, touching());
  EXPECT_EQ(counter("fingers_hovered"), 2U);
  see_for(3s, pipeline, touching());
  EXPECT_EQ(counter("fingers_hovered"), 2U) << "this one touches";
}

TEST_F(ActivePipelineTest, SendsTwoFingersAtATime) {
  const cv::Mat two = DrawnScene(border, image).finger(613, 55, 57).finger(713, 50, 70).noise(1, 4).picture();
  const TouchEvent* event = see(two);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.size(), 2U);
}

TEST_F(ActivePipelineTest, LearnsTheBackgroundFirstIfNobodyHasKeptIt) {
  ActivePipeline learning = pipeline_with(make_detector("default", calibration(), std::nullopt));
  for (int i = 0; i < 10; ++i) {
    const cv::Mat hand = DrawnScene(border, image).bar(100 + 60 * i, 300, -400, -5).noise(1, 4).picture();
    EXPECT_EQ(see_with(learning, hand), nullptr);
    EXPECT_FALSE(learning.knows_background()) << "something moves";
  }
  see_for(1s, learning, nobody());
  EXPECT_TRUE(learning.knows_background());
  EXPECT_EQ(counter("background_relearned"), 0U) << "it is the first";
  const TouchEvent* event = see_for(500ms, learning, touching());
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.size(), 1U);
}

// Lit from the other side, the strip looks different nearly everywhere.
TEST_F(ActivePipelineTest, LearnsTheBackgroundAnewAfterTheLightWasSwitchedAndTouchesNothingMeanwhile) {
  cv::Mat other_light = nobody().clone();
  for (int u = 0; u < other_light.cols; ++u)
    other_light.col(u) *= 0.3 + 1.8 * u / other_light.cols;
  cv::Mat touched = touching().clone();
  for (int u = 0; u < touched.cols; ++u)
    touched.col(u) *= 0.3 + 1.8 * u / touched.cols;

  see_for(500ms, pipeline, nobody());
  const Timestamp switched = clock.now();
  see(other_light);
  while (!pipeline.knows_background() || counter("background_relearned") == 0) {
    ASSERT_LT(clock.now() - switched, 2s);
    ASSERT_EQ(see(other_light), nullptr);
  }
  EXPECT_EQ(counter("touches_seen"), 0U);
  map.seen = clock.now();
  const TouchEvent* event = see(touched);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.size(), 1U);
}

TEST_F(ActivePipelineTest, SendsOneDownThenMovesThenOneUp) {
  const std::uint32_t id = see(touching())->contacts.at(0).id;
  for (int i = 0; i < 3; ++i) {
    const TouchEvent* event = see(touching());
    ASSERT_NE(event, nullptr);
    ASSERT_EQ(event->contacts.size(), 1U);
    EXPECT_EQ(event->contacts[0].id, id);
    EXPECT_EQ(event->contacts[0].phase, Phase::move);
  }
  int ups = 0;
  for (int i = 0; i < 20; ++i) {
    if (const TouchEvent* event = see(nobody())) {
      for (const Contact& contact : event->contacts)
        ups += contact.phase == Phase::up ? 1 : 0;
    }
  }
  EXPECT_EQ(ups, 1);
  EXPECT_EQ(see(nobody()), nullptr) << "there is nothing more to say";
  EXPECT_EQ(counter("touches_seen"), 1U);
  EXPECT_EQ(counter("frames"), 25U);
}

TEST_F(ActivePipelineTest, SaysWhatTheTouchIs) {
  EXPECT_EQ(see(touching())->contacts.at(0).gesture, Gesture::none);
  for (int i = 0; i < 12; ++i)
    see(touching());
  EXPECT_EQ(see(touching())->contacts.at(0).gesture, Gesture::hold);
  const TouchEvent* event = miss(200ms);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->transitions.back().contact.gesture, Gesture::hold);
}

TEST_F(ActivePipelineTest, SaysNothingWhileItIsNotSending) {
  EXPECT_EQ(see(touching(), false), nullptr);
  EXPECT_EQ(see(touching(), false), nullptr);
  EXPECT_EQ(counter("touches_seen"), 1U);
  const TouchEvent* event = see(touching(), true);
  ASSERT_NE(event, nullptr) << "the finger is still there";
  EXPECT_EQ(event->contacts.at(0).phase, Phase::down);
}

TEST_F(ActivePipelineTest, EndsWhatItSentWhenItStopsSending) {
  ASSERT_NE(see(touching()), nullptr);
  const TouchEvent* event = see(touching(), false);
  ASSERT_NE(event, nullptr);
  ASSERT_FALSE(event->transitions.empty());
  for (const Transition& transition : event->transitions)
    EXPECT_EQ(transition.contact.phase, Phase::up) << "a jacket that starts now must not feel what was stopped";
  for (const Contact& contact : event->contacts)
    EXPECT_EQ(contact.phase, Phase::up);
}

TEST_F(ActivePipelineTest, EndsATouchWhenNoPictureComes) {
  ASSERT_NE(see(touching()), nullptr);
  ASSERT_NE(miss(), nullptr) << "the finger may be there again in the next picture";
  const TouchEvent* event = miss(200ms);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->transitions.back().contact.phase, Phase::up);
  EXPECT_TRUE(pipeline.contacts().empty() || pipeline.contacts()[0].phase == Phase::up);
}

TEST_F(ActivePipelineTest, EndsATouchWhenTheMapBecomesTooOld) {
  ASSERT_NE(see(touching()), nullptr);
  map.seen = clock.now() - 10s;
  const TouchEvent* event = see(touching());
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->transitions.back().contact.phase, Phase::up);
}

TEST_F(ActivePipelineTest, CountsATouchWithoutAFaceAndSendsNothing) {
  map = {};
  EXPECT_EQ(see(touching()), nullptr);
  EXPECT_EQ(see(touching()), nullptr);
  EXPECT_EQ(pipeline.nobody_touched().no_face, 1U);
}

TEST_F(ActivePipelineTest, CountsPicturesOfAnotherSizeAndGoesOn) {
  EXPECT_EQ(see(cv::Mat(480, 640, CV_8UC3, cv::Scalar(0, 0, 0))), nullptr);
  EXPECT_EQ(see(cv::Mat()), nullptr);
  EXPECT_EQ(counter("frames_of_another_size"), 2U);
  EXPECT_NE(see(touching()), nullptr);
}

TEST_F(ActivePipelineTest, EndsATouchAndBeginsNoneWhileThePicturesCantBeBelieved) {
  ASSERT_NE(see(touching()), nullptr);
  const cv::Mat black(image.height_px, image.width_px, CV_8UC3, cv::Scalar(0, 0, 0));
  const TouchEvent* event = nullptr;
  for (int i = 0; i < 6; ++i)
    event = see(black);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->transitions.back().contact.phase, Phase::up);
  EXPECT_TRUE(event->contacts.empty());
  EXPECT_EQ(pipeline.verdict(), FrameVerdict::blank);
  EXPECT_EQ(counter("frames_blank"), 6U);
  for (int i = 0; i < 8; ++i)
    event = see(touching());
  EXPECT_EQ(pipeline.verdict(), FrameVerdict::good);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.size(), 1U) << "it recovers by itself";
}

TEST_F(ActivePipelineTest, EndsATouchOfACameraThatHangs) {
  ActivePipeline hanging(calibration(), detector_of(calibration(), "default", nobody()), ActivePipelineOptions{},
                         stream, clock, metrics);
  const TouchEvent* event = nullptr;
  for (int i = 0; i < 22; ++i) {
    clock.advance(frame_period);
    map.seen = frame.time = clock.now();
    frame.bgr = touching();
    event = hanging.process(frame, map, true);
  }
  ASSERT_NE(event, nullptr);
  EXPECT_TRUE(event->contacts.empty());
  EXPECT_EQ(hanging.verdict(), FrameVerdict::frozen);
  EXPECT_GT(counter("frames_frozen"), 0U);
}

TEST_F(ActivePipelineTest, BeginsNoTouchWhileTheLightChangesButGoesOnWithThoseThereAre) {
  cv::Mat dark;
  nobody().convertTo(dark, CV_8UC3, 0.5);
  see(dark);
  EXPECT_EQ(see(touching()), nullptr) << "the lamp was switched on in this frame";
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(see(touching()), nullptr);
  const TouchEvent* event = see(touching());
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.at(0).phase, Phase::down);
  EXPECT_EQ(counter("light_changes"), 1U);
}

TEST_F(ActivePipelineTest, LetsTimeRiseWhenAPictureIsOlderThanTheLastMiss) {
  ASSERT_NE(see(touching()), nullptr);
  const std::int64_t before_ns = miss()->frame_time_ns;
  clock.advance(1ms);
  frame.time = clock.now() - 20ms;
  const TouchEvent* event = pipeline.process(frame, map, true);
  ASSERT_NE(event, nullptr);
  EXPECT_GT(event->frame_time_ns, before_ns);
}

TEST_F(ActivePipelineTest, SendsAHugBesideTheFingerAndAloneWhileItIsNotSending) {
  see(touching());
  stream.hug().begin({}, clock.now());
  const TouchEvent* event = see(touching());
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.size(), 1 + HugPlayer::contacts_a_hug);
  EXPECT_EQ(event->body_map_version, 7U);
  event = see(touching(), false);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.size(), HugPlayer::contacts_a_hug);
  map = {};
  event = miss();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->contacts.size(), HugPlayer::contacts_a_hug);
  EXPECT_EQ(event->body_map_version, no_face_version);
}

// The receiver would take what begins at 1 again, in one session, for doubled.
TEST_F(ActivePipelineTest, CountsOnAfterTheCalibrationWasChanged) {
  see(touching());
  const TouchEvent* event = see(touching());
  ASSERT_NE(event, nullptr);
  const std::uint64_t before = event->sequence;
  ActivePipeline recalibrated = pipeline_with(detector_of(calibration(), "default", nobody()));
  event = see_with(recalibrated, touching());
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->sequence, before + 1);
}

TEST_F(ActivePipelineTest, AllocatesNothingPerFrameAfterTheFirst) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  see(touching());
  see(nobody());
  const std::uint64_t before = allocation_count();
  int events = 0;
  for (int i = 0; i < 200; ++i) {
    map.seen = clock.now();
    events += see(i % 40 < 20 ? touching() : nobody()) != nullptr ? 1 : 0;
  }
  for (int i = 0; i < 5; ++i)
    miss();
  EXPECT_EQ(allocation_count() - before, 0U);
  EXPECT_GT(events, 100);
}

TEST_F(ActivePipelineTest, AllocatesNothingWhileItLearnsTheBackground) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  ActivePipeline learning = pipeline_with(make_detector("default", calibration(), std::nullopt));
  see_with(learning, nobody());
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 30; ++i)
    see_with(learning, nobody());
  EXPECT_TRUE(learning.knows_background());
  EXPECT_EQ(allocation_count() - before, 0U);
}

TEST_F(ActivePipelineTest, AllocatesNothingWithTheThesisDetector) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  ActivePipeline thesis = pipeline_with(detector_of(calibration(), "thesis", nobody()));
  see_with(thesis, touching());
  see_with(thesis, nobody());
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 20; ++i)
    see_with(thesis, i % 10 < 5 ? touching() : nobody());
  EXPECT_EQ(allocation_count() - before, 0U);
}

}  // namespace
}  // namespace telehug
