// SPDX-License-Identifier: Apache-2.0
#include "capture/webcam_device.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

TEST(Webcams, AreListedByNamesForPeopleWithoutTheirFurtherDevices) {
  const TemporaryFolder folder;
  for (const char* file : {"usb-Z_Cam_1-video-index0", "usb-046d_HD_Pro_Webcam_C920_A5-video-index0",
                           "usb-046d_HD_Pro_Webcam_C920_A5-video-index1", "notes.txt"})
    std::ofstream(folder / file) << "";
  const auto webcams = list_webcams(folder / "");
  ASSERT_EQ(webcams.size(), 2U);
  EXPECT_EQ(webcams[0].name, "046d HD Pro Webcam C920 A5");
  EXPECT_EQ(webcams[0].path, (folder / "usb-046d_HD_Pro_Webcam_C920_A5-video-index0").string());
  EXPECT_EQ(webcams[1].name, "Z Cam 1");
}

TEST(Webcams, AreNoneWhereNoneWasEverPluggedIn) {
  const TemporaryFolder folder;
  EXPECT_TRUE(list_webcams(folder / "by-id").empty());
}

}  // namespace
}  // namespace telehug
