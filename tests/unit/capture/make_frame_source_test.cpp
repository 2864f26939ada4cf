// SPDX-License-Identifier: Apache-2.0
#include "capture/make_frame_source.hpp"

#include <gmock/gmock.h>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

class MakeFrameSource : public ::testing::Test {
 protected:
  MakeFrameSource() {
    settings_.virtual_rig.image = {128, 72};
    settings_.virtual_rig.focal_px = 95;
  }
  std::string name_of(std::string_view spec) {
    const auto source = make_frame_source(spec, settings_, clock_);
    return source.ok() ? (*source)->name() : "error: " + source.error().message;
  }

  CaptureSettings settings_;
  FakeClock clock_;
};

TEST_F(MakeFrameSource, MakesWhatTheSpecNames) {
  settings_.device = "/dev/v4l/by-id/from-settings";
  EXPECT_EQ(name_of("webcam"), "webcam /dev/v4l/by-id/from-settings");
  EXPECT_EQ(name_of("webcam:/dev/video7"), "webcam /dev/video7");
  EXPECT_EQ(name_of("replay:/some/where"), "recording /some/where");
  EXPECT_EQ(name_of("virtual"), "virtual");
  EXPECT_EQ(name_of("virtual:7?/some/where"), "virtual");
}

TEST_F(MakeFrameSource, TellsAVirtualRigsSeedFromTheFolderThatDirectsIt) {
  const auto rig = virtual_rig_spec("virtual:7?/some/where?else");
  ASSERT_TRUE(rig);
  EXPECT_EQ(rig->seed, 7u);
  EXPECT_EQ(rig->directed_from, "/some/where?else");
  EXPECT_FALSE(virtual_rig_spec("virtual")->seed);
  EXPECT_EQ(virtual_rig_spec("virtual")->directed_from, "");
  for (const char* none :
       {"webcam", "virtual:", "virtual:x", "virtual:7x", "virtual?", "virtual:7?", "virtual:4294967296"})
    EXPECT_FALSE(virtual_rig_spec(none)) << none;
}

TEST_F(MakeFrameSource, ChoosesTheWebcamItselfWhenNoneIsNamed) {
  EXPECT_THAT(name_of("webcam"), HasSubstr("webcam /dev/v"));
}

TEST_F(MakeFrameSource, ReplaysThePartAfterAQuestionMark) {
  settings_.real_time = false;
  auto source = make_frame_source("replay:" TELEHUG_FIXTURES "/rig1?frames", settings_, clock_);
  ASSERT_TRUE(source);
  ASSERT_TRUE((*source)->open());
  Frame frame;
  EXPECT_EQ((*source)->read(frame, 0ms), ReadOutcome::frame);
  EXPECT_EQ((*source)->read(frame, 0ms), ReadOutcome::frame);
  EXPECT_EQ((*source)->read(frame, 0ms), ReadOutcome::ended);

  source = make_frame_source("replay:" TELEHUG_FIXTURES "/rig1?nothing", settings_, clock_);
  ASSERT_TRUE(source);
  EXPECT_THAT((*source)->open().error().message, HasSubstr("'nothing'"));
}

TEST_F(MakeFrameSource, SaysWhichSourcesThereAreForAnythingElse) {
  for (const char* spec : {"", "web cam", "replay", "replay:", "virtual:x"}) {
    EXPECT_THAT(name_of(spec), HasSubstr("sources are webcam")) << spec;
  }
}

TEST_F(MakeFrameSource, SaysWhyAVirtualRigCantBe) {
  settings_.virtual_rig.hand.skin_tone = 7;
  EXPECT_THAT(name_of("virtual"), HasSubstr("skin_tone must be 1 to 6"));
}

}  // namespace
}  // namespace telehug
