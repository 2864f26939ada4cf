// SPDX-License-Identifier: Apache-2.0
#include "config/locator.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

TEST(CameraSource, IsAWebcamARecordingOrTheVirtualRig) {
  EXPECT_EQ(parse_camera_source("webcam")->kind, CameraSourceKind::webcam);
  EXPECT_EQ(parse_camera_source("virtual")->kind, CameraSourceKind::virtual_rig);
  EXPECT_EQ(parse_camera_source("virtual:12")->kind, CameraSourceKind::virtual_rig);
  EXPECT_EQ(parse_camera_source("virtual?/a/b?c")->kind, CameraSourceKind::virtual_rig);
  EXPECT_EQ(parse_camera_source("virtual:12?/a/b")->kind, CameraSourceKind::virtual_rig);
  const auto recording = parse_camera_source("replay:/a/b:c");
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->kind, CameraSourceKind::recording);
  EXPECT_EQ(recording->folder, "/a/b:c");
  for (const char* wrong : {"", "replay:", "replay", "webcam ", "VIRTUAL", "virtual:", "virtual:-1", "virtual:x",
                            "virtual:1234567890", "virtual?", "virtual:12?", "webcam?/a"})
    EXPECT_FALSE(parse_camera_source(wrong));
}

TEST(ScreenSource, IsAScreenAPictureACameraOrARecording) {
  EXPECT_EQ(parse_screen_source("auto")->kind, ScreenSourceKind::automatic);
  EXPECT_EQ(parse_screen_source("x11")->kind, ScreenSourceKind::x11);
  EXPECT_EQ(parse_screen_source("portal")->kind, ScreenSourceKind::portal);
  EXPECT_EQ(parse_screen_source("picture")->kind, ScreenSourceKind::picture);
  EXPECT_EQ(parse_screen_source("camera:/dev/video2")->place, "/dev/video2");
  EXPECT_EQ(parse_screen_source("replay:/a b")->kind, ScreenSourceKind::recording);
  for (const char* wrong : {"", "camera:", "camera", "replay:", "x11 ", "X11", "wayland"})
    EXPECT_FALSE(parse_screen_source(wrong));
}

TEST(ScreenRegion, IsNoneOrFourNumbers) {
  EXPECT_FALSE(*parse_screen_region(""));
  const auto region = parse_screen_region("10,0,640,480");
  ASSERT_TRUE(region && *region);
  EXPECT_EQ((*region)->x_px, 10);
  EXPECT_EQ((*region)->y_px, 0);
  EXPECT_EQ((*region)->width_px, 640);
  EXPECT_EQ((*region)->height_px, 480);
  for (const char* wrong : {"1,2,3", "1,2,3,4,5", "1,2,3,4,", ",1,2,3,4", "-1,0,5,5", "0,0,0,5", "0,0,5,0", "a,b,c,d",
                            "0,0,99999,5", "1, 2,3,4", "1,2,3,99999999999999"})
    EXPECT_FALSE(parse_screen_region(wrong)) << wrong;
}

TEST(JacketLinkChoice, IsASerialLineBluetoothTheSimulationOrAFile) {
  EXPECT_EQ(parse_jacket_link("simulated")->kind, JacketLinkKind::simulated);
  EXPECT_EQ(parse_jacket_link("serial:/dev/ttyACM0")->path, "/dev/ttyACM0");
  EXPECT_EQ(parse_jacket_link("record:out.bin")->kind, JacketLinkKind::recorded);
  EXPECT_EQ(parse_jacket_link("rfcomm:00:11:22:33:44:55/3")->kind, JacketLinkKind::bluetooth);
  EXPECT_EQ(parse_jacket_link("rfcomm:00:11:22:33:44:55/3")->path, "00:11:22:33:44:55/3");
  for (const char* wrong :
       {"", "serial:", "record:", "serial", "usb:x", "rfcomm:", "rfcomm:00:11:22:33:44", "rfcomm:00:11:22:33:44:55/31"})
    EXPECT_FALSE(parse_jacket_link(wrong));
}

TEST(Addresses, HaveCommasBetweenThem) {
  EXPECT_TRUE(parse_addresses("")->empty());
  EXPECT_EQ(*parse_addresses("192.0.2.7"), std::vector<std::string>{"192.0.2.7"});
  EXPECT_EQ(*parse_addresses("192.0.2.7, 198.51.100.1"), (std::vector<std::string>{"192.0.2.7", "198.51.100.1"}));
  for (const char* wrong : {",", "192.0.2.7,", " ", "192.0.2", "192.0.2.7 198.51.100.1", "::1"})
    EXPECT_FALSE(parse_addresses(wrong)) << wrong;
}

TEST(Addresses, MayHaveAPortEach) {
  EXPECT_EQ(*parse_addresses("192.0.2.7:7600,198.51.100.1"),
            (std::vector<std::string>{"192.0.2.7:7600", "198.51.100.1"}));
  for (const char* wrong : {"192.0.2.7:", "192.0.2.7:0", "192.0.2.7:65536", "192.0.2.7:-1", "192.0.2.7:7600:1",
                            "192.0.2.7:76 00", ":7600", "grandma:7600"})
    EXPECT_FALSE(parse_addresses(wrong)) << wrong;
}

TEST(PublicAddress, IsOneIpv4AddressOrNone) {
  EXPECT_EQ(*parse_address(""), "");
  EXPECT_EQ(*parse_address("198.51.100.7"), "198.51.100.7");
  for (const char* wrong : {"198.51.100", "198.51.100.7:7600", "198.51.100.7,198.51.100.8", "grandma", "::1", " "})
    EXPECT_FALSE(parse_address(wrong)) << wrong;
}

}  // namespace
}  // namespace telehug
