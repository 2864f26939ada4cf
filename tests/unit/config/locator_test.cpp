// SPDX-License-Identifier: Apache-2.0
#include "config/locator.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

TEST(CameraSource, IsAWebcamARecordingOrTheVirtualRig) {
  EXPECT_EQ(parse_camera_source("webcam")->kind, CameraSourceKind::webcam);
  EXPECT_EQ(parse_camera_source("virtual")->kind, CameraSourceKind::virtual_rig);
  EXPECT_EQ(parse_camera_source("virtual:12")->kind, CameraSourceKind::virtual_rig);
  const auto recording = parse_camera_source("replay:/a/b:c");
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->kind, CameraSourceKind::recording);
  EXPECT_EQ(recording->folder, "/a/b:c");
  for (const char* wrong : {"", "replay:", "replay", "webcam ", "VIRTUAL", "virtual:", "virtual:-1", "virtual:x", "virtual:1234567890"})
    EXPECT_FALSE(parse_camera_source(wrong));
}

TEST(JacketLinkChoice, IsASerialLineTheSimulationOrAFile) {
  EXPECT_EQ(parse_jacket_link("simulated")->kind, JacketLinkKind::simulated);
  EXPECT_EQ(parse_jacket_link("serial:/dev/ttyACM0")->path, "/dev/ttyACM0");
  EXPECT_EQ(parse_jacket_link("record:out.bin")->kind, JacketLinkKind::recorded);
  for (const char* wrong : {"", "serial:", "record:", "serial", "usb:x"})
    EXPECT_FALSE(parse_jacket_link(wrong));
}

}  // namespace
}  // namespace telehug
