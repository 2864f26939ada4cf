// SPDX-License-Identifier: Apache-2.0
//
// Files and devices that are missing or broken: a sentence says which and what to do, the daemon lives and takes them
// as soon as they are right. A configuration that is wrong is refused as a whole, with all its faults.
#include <gmock/gmock.h>

#include <fstream>

#include "integration/app/running_pair.hpp"
#include "service/control_socket.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class BadInput : public testing::Test {
 protected:
  static constexpr const char* rig = "replay:" TELEHUG_FIXTURES "/rig2";

  void start_all() {
    pair.start_jacket();
    pair.start_passive();
    pair.start_active();
  }
  void expect_felt() {
    EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  }

  RunningPair pair;
};

TEST_F(BadInput, ARecordingThatIsMissingIsToldAndReplayedWhenItIsThere) {
  pair.calibrate(rig);
  const auto folder = pair.folder / "later";
  pair.camera = "replay:" + folder.string();
  start_all();
  ASSERT_TRUE(eventually([&] { return pair.complains(Side::active, folder.string()); })) << pair.logs();
  EXPECT_GE(pair.counter(Side::active, "camera_losses"), 1U);
  EXPECT_EQ(pair.status(Side::active).at("state"), "fault");
  EXPECT_FALSE(pair.camera_open());

  std::filesystem::create_directory(folder);
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "there is no .jpg or .png picture to replay"); }))
      << pair.logs();
  std::filesystem::copy(TELEHUG_FIXTURES "/rig2/sequence/012.jpg", pair.folder / "1.tmp");
  std::filesystem::rename(pair.folder / "1.tmp", folder / "1.jpg");
  expect_felt();
}

TEST_F(BadInput, ARecordingWithAnUnreadablePictureGoesOnWithTheOthers) {
  pair.calibrate(rig);
  const auto folder = pair.folder / "partly";
  std::filesystem::create_directory(folder);
  for (const char* name : {"1.jpg", "2.jpg", "3.jpg"})
    std::filesystem::copy(TELEHUG_FIXTURES "/rig2/sequence/012.jpg", folder / name);
  std::ofstream(folder / "2.jpg", std::ios::trunc) << "this is no picture";
  pair.camera = "replay:" + folder.string();
  start_all();
  expect_felt();
  EXPECT_TRUE(eventually([&] { return pair.counter(Side::active, "frames_broken") > 2; })) << pair.logs();
  EXPECT_TRUE(pair.active->runs());
}

TEST_F(BadInput, AWebcamThatIsMissingIsToldByName) {
  pair.calibrate(rig);
  pair.camera = "webcam";
  const std::string device = (pair.folder / "no-camera").string();
  pair.active_settings = {"camera.device=" + device};
  start_all();
  ASSERT_TRUE(eventually([&] { return pair.complains(Side::active, device); })) << pair.logs();
  EXPECT_GE(pair.counter(Side::active, "camera_losses"), 1U);
  EXPECT_EQ(pair.status(Side::active).at("state"), "fault");
  EXPECT_EQ(pair.active->end(), to_int(ExitCode::ok));
}

TEST_F(BadInput, ACalibrationThatIsMissingIsToldAndUsedWhenItIsThere) {
  start_all();
  ASSERT_TRUE(eventually([&] { return pair.complains(Side::active, "there is no calibration yet"); })) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::active, "telehug-active calibrate"));
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, pair.calibration.string()); }));
  EXPECT_EQ(pair.status(Side::active).at("state"), "fault");
  EXPECT_EQ(pair.status(Side::active).at("camera").at("why"), "not calibrated");
  pair.calibrate(rig);
  expect_felt();
}

TEST_F(BadInput, ACalibrationThatIsCorruptIsToldWithItsLineAndUsedWhenItIsRight) {
  pair.folder.write("rig.toml", "version = 1\ncamera = \"none\"\n[image]\nwidth_px = -3\n");
  start_all();
  const std::string line = pair.calibration.string() + ":4:";
  ASSERT_TRUE(eventually([&] { return pair.complains(Side::active, line); })) << pair.logs();
  pair.calibrate(rig);
  expect_felt();
  EXPECT_FALSE(pair.complains(Side::active, line));
}

TEST_F(BadInput, ACalibrationThatBecomesCorruptLeavesTheOneInUse) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  pair.folder.write("rig.toml", "version = [");
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, pair.calibration.string() + ":1:"); }))
      << pair.logs();
  EXPECT_TRUE(pair.active->runs());
  expect_felt();
}

TEST_F(BadInput, AWrongConfigurationIsRefusedWithAllItsFaults) {
  for (const Side side : {Side::active, Side::passive}) {
    const auto file = pair.folder.write("wrong.toml",
                                        "[peer]\n"
                                        "domain = \"seventy\"\n"
                                        "[control]\n"
                                        "sockt = \"x\"\n"
                                        "[log]\n"
                                        "level = \"loud\"\n");
    const Outcome outcome =
        pair.run({std::string(TELEHUG_BIN "/telehug-") + side_name(side), "run", "--config", file.string()});
    EXPECT_EQ(outcome.code, to_int(ExitCode::config)) << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr(file.string() + ":2:"), HasSubstr(file.string() + ":4:"),
                                    HasSubstr(file.string() + ":6:")));
  }
}

TEST_F(BadInput, AWrongJacketProfileIsRefusedWithItsLine) {
  const auto file = pair.folder.write("jacket.toml", "version = 1\nname = 5\nbaud = 57600\n");
  const Outcome outcome = pair.run(
      {TELEHUG_BIN "/telehug-passive", "run", "--config", "/dev/null", "--set", "jacket.profile=" + file.string()});
  EXPECT_EQ(outcome.code, to_int(ExitCode::config)) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr(file.string() + ":2:"));
}

TEST_F(BadInput, ASecondDaemonOnTheSameSocketIsRefusedAndTheFirstGoesOn) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  const Outcome second_active = pair.run(pair.active_command());
  EXPECT_EQ(second_active.code, to_int(ExitCode::already_running)) << second_active.text;
  const Outcome second_passive = pair.run(pair.passive_command());
  EXPECT_EQ(second_passive.code, to_int(ExitCode::already_running)) << second_passive.text;
  EXPECT_TRUE(pair.status(Side::active).is_object());
  EXPECT_TRUE(pair.status(Side::passive).is_object());
  expect_felt();
}

// Started again by systemd it would fail again, for ever.
TEST_F(BadInput, AGroupThatTheSocketCannotBeGivenToIsAFaultOfTheConfiguration) {
  pair.active_settings.emplace_back("control.group=no-such-group-here");
  pair.passive_settings.emplace_back("control.group=no-such-group-here");
  for (const auto& command : {pair.active_command(), pair.passive_command()}) {
    const Outcome outcome = pair.run(command);
    EXPECT_EQ(outcome.code, to_int(ExitCode::config)) << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr("control.group = \"no-such-group-here\": there is no such group"),
                                    HasSubstr("Leave it empty")));
  }
}

}  // namespace
}  // namespace telehug
