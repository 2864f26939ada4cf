// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_setup.hpp"

#include <gmock/gmock.h>

#include "capture/webcam.hpp"
#include "doubles/fake_camera_controls.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/test_pictures.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

class ACamerasSetup : public ::testing::Test {
 protected:
  ACamerasSetup() { device_.controls = usual_controls(); }

  CameraSetupSettings settings(CameraPreset preset) const {
    return {preset, 0, folder_ / "camera.toml", folder_ / "camera-before.toml"};
  }
  Webcam webcam(const CameraSetupSettings& setup) { return {{"/dev/video0", {128, 72}, 30, setup}, clock_, device_}; }
  ControlValues now() const {
    ControlValues values;
    for (const auto& control : device_.controls)
      values.push_back({control.id, control.value});
    return values;
  }
  [[nodiscard]] bool remembers() const { return std::filesystem::exists(folder_ / "camera-before.toml"); }

  TemporaryFolder folder_;
  FakeClock clock_;
  FakeV4l2 device_{clock_};
};

TEST_F(ACamerasSetup, ListsWhatCanBeSet) {
  CameraControls controls(device_);
  ASSERT_TRUE(controls.open("/dev/video0"));
  const auto list = controls.list();
  ASSERT_EQ(list.size(), device_.controls.size() - 1) << "without the one that is read-only";
  const auto exposure = std::ranges::find(list, V4L2_CID_EXPOSURE_ABSOLUTE, &CameraControl::id);
  ASSERT_NE(exposure, list.end());
  EXPECT_EQ(exposure->name, "Exposure Time, Absolute");
  EXPECT_EQ(exposure->maximum, 2047);
  EXPECT_EQ(exposure->value, 250);
  EXPECT_TRUE(exposure->inactive);
}

TEST_F(ACamerasSetup, KeepsTheCameraAsItIsIfItShall) {
  const auto before = now();
  Webcam camera = webcam(settings(CameraPreset::keep));
  ASSERT_TRUE(camera.open());
  EXPECT_EQ(now(), before);
  EXPECT_EQ(device_.control_changes, 0);
  EXPECT_EQ(camera.setup(), "");
  EXPECT_FALSE(remembers());
}

TEST_F(ACamerasSetup, FixesEveryAutomaticAtWhatItHadArrivedAt) {
  Webcam camera = webcam(settings(CameraPreset::fixed));
  ASSERT_TRUE(camera.open());
  EXPECT_EQ(device_.control(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(device_.control(V4L2_CID_EXPOSURE_AUTO_PRIORITY), 0);
  EXPECT_EQ(device_.control(V4L2_CID_AUTO_WHITE_BALANCE), 0);
  EXPECT_EQ(device_.control(V4L2_CID_FOCUS_AUTO), 0);
  EXPECT_EQ(device_.control(V4L2_CID_EXPOSURE_ABSOLUTE), 250);
  EXPECT_EQ(device_.control(V4L2_CID_FOCUS_ABSOLUTE), 30);
  EXPECT_EQ(device_.control(V4L2_CID_WHITE_BALANCE_TEMPERATURE), 4000);
  EXPECT_EQ(camera.setup(), "thesis: 7 settings");
}

TEST_F(ACamerasSetup, SetsWhatWasTunedForThisCamera) {
  const auto before = now();
  const ControlValues tuned{{V4L2_CID_EXPOSURE_ABSOLUTE, 120}, {V4L2_CID_CONTRAST, 40}};
  ASSERT_TRUE(write_camera_memory(folder_ / "camera.toml", {"/dev/video0", tuned}));
  Webcam camera = webcam(settings(CameraPreset::tuned));
  ASSERT_TRUE(camera.open());
  EXPECT_EQ(device_.control(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(device_.control(V4L2_CID_EXPOSURE_ABSOLUTE), 120);
  EXPECT_EQ(device_.control(V4L2_CID_CONTRAST), 40);
  EXPECT_EQ(device_.control(V4L2_CID_FOCUS_AUTO), 0);
  camera.close();
  EXPECT_EQ(now(), before) << "the exposure can't be put back while its automatic is on";
}

TEST_F(ACamerasSetup, KeepsACameraThatWasNotTuned) {
  ASSERT_TRUE(write_camera_memory(folder_ / "camera.toml", {"/dev/video7", {{V4L2_CID_CONTRAST, 40}}}));
  Webcam camera = webcam(settings(CameraPreset::tuned));
  ASSERT_TRUE(camera.open());
  EXPECT_EQ(device_.control_changes, 0);
}

TEST_F(ACamerasSetup, SetsThePowerLinesFrequencyWithEveryPreset) {
  CameraSetupSettings keep = settings(CameraPreset::keep);
  keep.power_line_hz = 50;
  Webcam camera = webcam(keep);
  ASSERT_TRUE(camera.open());
  EXPECT_EQ(device_.control(V4L2_CID_POWER_LINE_FREQUENCY), V4L2_CID_POWER_LINE_FREQUENCY_50HZ);
  EXPECT_EQ(device_.control_changes, 1);
}

TEST_F(ACamerasSetup, PutsEverythingBackWhenTheCameraIsClosed) {
  const auto before = now();
  Webcam camera = webcam(settings(CameraPreset::fixed));
  ASSERT_TRUE(camera.open());
  ASSERT_NE(now(), before);
  EXPECT_TRUE(remembers());
  camera.close();
  EXPECT_EQ(now(), before);
  EXPECT_FALSE(remembers());
  EXPECT_EQ(device_.open_now, 0);
}

// Nobody closed it: the file is all that is left.
TEST_F(ACamerasSetup, PutsBackWhatAKilledProgramLeftChanged) {
  const auto before = now();
  CameraSetup killed(settings(CameraPreset::fixed), device_);
  killed.apply("/dev/video0");
  ASSERT_NE(now(), before);
  const auto count = put_back_camera(folder_ / "camera-before.toml", device_);
  ASSERT_TRUE(count);
  EXPECT_EQ(*count, 7);
  EXPECT_EQ(now(), before);
  EXPECT_FALSE(remembers());
}

TEST_F(ACamerasSetup, DoesNotTakeAKilledProgramsSettingsForTheUsers) {
  const auto before = now();
  ASSERT_TRUE(write_camera_memory(folder_ / "camera.toml", {"/dev/video0", {{V4L2_CID_CONTRAST, 40}}}));
  CameraSetup killed(settings(CameraPreset::tuned), device_);
  killed.apply("/dev/video0");
  Webcam camera = webcam(settings(CameraPreset::tuned));
  ASSERT_TRUE(camera.open());
  EXPECT_EQ(device_.control(V4L2_CID_CONTRAST), 40);
  camera.close();
  EXPECT_EQ(now(), before);
}

TEST_F(ACamerasSetup, IsAppliedAgainToACameraThatComesBackAndStillPutBack) {
  const auto before = now();
  Webcam camera = webcam(settings(CameraPreset::fixed));
  ASSERT_TRUE(camera.open());
  device_.unplug();
  Frame frame;
  EXPECT_EQ(camera.read(frame, 100ms), ReadOutcome::lost);
  device_.plugged = true;
  EXPECT_EQ(camera.read(frame, 1s), ReadOutcome::timeout);
  EXPECT_EQ(device_.control(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  camera.close();
  EXPECT_EQ(now(), before);
}

TEST_F(ACamerasSetup, SaysWhichSettingIsRefusedAndSetsTheOthers) {
  device_.refused = V4L2_CID_FOCUS_AUTO;
  Webcam camera = webcam(settings(CameraPreset::fixed));
  ASSERT_TRUE(camera.open());
  EXPECT_THAT(camera.setup(), HasSubstr("thesis: 5 settings"));
  EXPECT_THAT(camera.setup(), HasSubstr("0x009a090c"));
  EXPECT_EQ(device_.control(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
}

TEST_F(ACamerasSetup, ChangesNothingThatItCouldNotPutBack) {
  CameraSetupSettings nowhere = settings(CameraPreset::fixed);
  nowhere.before_file = "/proc/nowhere/camera-before.toml";
  Webcam camera = webcam(nowhere);
  ASSERT_TRUE(camera.open());
  EXPECT_EQ(device_.control_changes, 0);
  EXPECT_THAT(camera.setup(), HasSubstr("can't be written"));
}

TEST_F(ACamerasSetup, RefusesAFileThatHoldsSomethingElse) {
  std::string deep = "a";  // toml++ takes tables within tables apart recursively
  for (int i = 0; i < 100'000; ++i)
    deep += ".a";
  EXPECT_FALSE(read_camera_memory(folder_.write("deep.toml", deep + " = 1")));
  for (const char* text : {"device = 3", "device = \"x\"\ncontrols = [[1]]", "controls = [[1, 2]]", "][",
                           "device = \"x\"\ncontrols = [[-1, 2]]", "device = \"x\"\ncontrols = [[1, 99999999999]]"}) {
    const auto path = folder_.write("broken.toml", text);
    EXPECT_FALSE(read_camera_memory(path)) << text;
  }
}

}  // namespace
}  // namespace telehug
