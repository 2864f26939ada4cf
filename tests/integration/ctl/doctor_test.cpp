// SPDX-License-Identifier: Apache-2.0
//
// `telehug doctor` on set-ups that are broken on purpose: each is named, with what mends it.
#include <gmock/gmock.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "doubles/temporary_folder.hpp"
#include "integration/cli/shell.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

// A PC on which nothing is wrong; each test breaks one thing.
class Doctor : public testing::Test {
 protected:
  Doctor() {
    folder.write("root/dev/video0", "");
    folder.write("root/dev/ttyACM0", "");
    folder.write("root/proc/version", "Linux version 6.1.0-50-amd64 (Debian 6.1.176-1)");
    folder.write("root/sys/class/bluetooth/hci0/address", "");
    folder.write("root/proc/net/udp", "  sl  local_address\n");
    folder.write("root/sys/class/drm/card0-DP-1/status", "connected\n");
    std::string edid(128, '\0');
    edid[66] = static_cast<char>(520 & 0xFF);
    edid[67] = static_cast<char>(290 & 0xFF);
    edid[68] = static_cast<char>(((520 >> 8) << 4) | (290 >> 8));
    folder.write("root/sys/class/drm/card0-DP-1/edid", edid);
    calibrate(521, 291);
    folder.write("config/telehug/active.toml", "[body_map]\npicture = \"chat.jpg\"\n");
    folder.write("config/telehug/passive.toml", "[jacket]\nlink = \"serial:/dev/ttyACM0\"\n");
    fs::create_directories(folder / "state/telehug/pairs/active");
    fs::create_directories(folder / "state/telehug/pairs/passive");
    for (const char* name : {"active", "passive"})
      fs::permissions(folder / "state/telehug/pairs" / name, fs::perms::owner_all);
  }
  void calibrate(int width_mm, int height_mm) const {
    folder.write("state/telehug/rig.toml", "[screen]\nwidth_mm = " + std::to_string(width_mm) +
                                               "\nheight_mm = " + std::to_string(height_mm) + "\n");
  }

  // Its findings of that level. Root may do everything: then another user asks.
  [[nodiscard]] Json ask(const std::string& side, const std::string& level, int* code = nullptr) const {
    const std::string base = folder.path().string();
    std::string who;
    if (::geteuid() == 0) {
      (void)shell("chown -R 65534:65534 " + base);
      who = "setpriv --reuid=65534 --regid=65534 --clear-groups ";
    }
    const ShellRun run = shell(who + "env -u WAYLAND_DISPLAY DISPLAY=" + display + " XDG_CONFIG_HOME=" + base +
                               "/config XDG_STATE_HOME=" + base + "/state XDG_RUNTIME_DIR=" + base +
                               "/run " TELEHUG_BIN "/telehug doctor " + side + " --json --root " + base + "/root");
    if (code != nullptr) *code = run.code;
    Json found = Json::array();
    const Json all = Json::parse(run.text);
    for (const Json& finding : all.at("findings"))
      if (finding.at("level") == level) found.push_back(finding);
    return found;
  }
  void expect(const std::string& side, const std::string& level, const std::string& check, const std::string& what,
              const std::string& fix) const {
    int code = -1;
    const Json found = ask(side, level, &code);
    std::string texts;
    for (const Json& finding : found)
      if (finding.at("check") == check)
        texts += finding.at("what").get<std::string>() + " -> " + finding.at("fix").get<std::string>() + "\n";
    EXPECT_THAT(texts, AllOf(HasSubstr(what), HasSubstr(fix))) << found.dump(1);
    EXPECT_EQ(code == to_int(ExitCode::fault), level == "fail");
  }
  void forbid(const std::string& path) const { fs::permissions(folder / path, fs::perms::none); }

  TemporaryFolder folder;
  std::string display = ":0";
};

TEST_F(Doctor, FindsNothingToFailWhereNothingIsWrong) {
  int code = -1;
  EXPECT_THAT(ask("", "fail", &code), IsEmpty());
  EXPECT_EQ(code, 0);
}

TEST_F(Doctor, NamesACameraThatIsNotThere) {
  fs::remove(folder / "root/dev/video0");
  expect("active", "fail", "camera", "no webcam", "plug it in");
}

TEST_F(Doctor, NamesACameraWithoutRights) {
  forbid("root/dev/video0");
  expect("active", "fail", "camera", "/dev/video0 may not be used", "usermod -aG video");
}

TEST_F(Doctor, NamesAMissingCalibration) {
  fs::remove(folder / "state/telehug/rig.toml");
  expect("active", "fail", "calibration", "rig.toml", "telehug-active calibrate");
}

TEST_F(Doctor, NamesACalibrationThatCanNotBeRead) {
  folder.write("state/telehug/rig.toml", "[screen\n");
  expect("active", "fail", "calibration", "rig.toml", "telehug-active calibrate");
}

TEST_F(Doctor, NamesACalibrationOfAnotherMonitor) {
  calibrate(380, 300);
  expect("active", "warn", "calibration", "520 x 290 mm", "telehug-active calibrate");
}

TEST_F(Doctor, NamesASessionWithoutDesktop) {
  folder.write("config/telehug/active.toml", "");
  display = "";
  expect("active", "fail", "screen", "no desktop", "session of the person");
}

TEST_F(Doctor, NamesAFaultyConfigurationByFileAndLine) {
  folder.write("config/telehug/active.toml", "[camera]\nfps = 1000\n");
  expect("active", "fail", "config", "active.toml:2: camera.fps", "telehug config check");
}

TEST_F(Doctor, NamesAJacketThatIsNotPluggedIn) {
  fs::remove(folder / "root/dev/ttyACM0");
  expect("passive", "fail", "jacket port", "/dev/ttyACM0 is not there", "plug the jacket in");
}

TEST_F(Doctor, NamesAJacketsPortWithoutRights) {
  forbid("root/dev/ttyACM0");
  expect("passive", "fail", "jacket port", "/dev/ttyACM0", "usermod -aG dialout");
}

TEST_F(Doctor, NamesAMissingBluetoothAdapter) {
  folder.write("config/telehug/passive.toml", "[jacket]\nlink = \"rfcomm:00:11:22:33:44:55\"\n");
  fs::remove_all(folder / "root/sys/class/bluetooth");
  expect("passive", "fail", "bluetooth", "no Bluetooth adapter", "plug one in");
}

TEST_F(Doctor, NamesBluetoothThatIsSwitchedOff) {
  folder.write("config/telehug/passive.toml", "[jacket]\nlink = \"rfcomm:00:11:22:33:44:55\"\n");
  folder.write("root/sys/class/rfkill/rfkill0/type", "bluetooth\n");
  folder.write("root/sys/class/rfkill/rfkill0/soft", "1\n");
  expect("passive", "fail", "bluetooth", "switched off", "rfkill unblock bluetooth");
}

TEST_F(Doctor, NamesAKernelWhoseBluetoothCrashes) {
  folder.write("config/telehug/passive.toml", "[jacket]\nlink = \"rfcomm:00:11:22:33:44:55\"\n");
  folder.write("root/proc/version", "Linux version 6.1.0-56-amd64 (x) #1 SMP Debian 6.1.192-2 (2026-10-01)");
  expect("passive", "fail", "kernel", "6.1.192", "6.1.0-50");
}

TEST_F(Doctor, NamesAStateFolderThatOthersMayLookInto) {
  fs::permissions(folder / "state/telehug/pairs/passive", fs::perms::owner_all | fs::perms::others_read);
  expect("passive", "fail", "state folder", "private keys", "chmod 700");
}

TEST_F(Doctor, NamesAPortThatAnotherProgramHas) {
  // 26660 = 0x6824
  folder.write("root/proc/net/udp", "  sl  local_address\n   1: 00000000:6824 00000000:0000 07\n");
  expect("passive", "warn", "ports", "26660", "ss -ulpn");
}

TEST_F(Doctor, LooksOnlyAtTheSideThatIsUsedHere) {
  fs::remove(folder / "config/telehug/active.toml");
  fs::remove(folder / "state/telehug/rig.toml");
  EXPECT_THAT(ask("", "ok").dump(), AllOf(HasSubstr("passive: no fault"), testing::Not(HasSubstr("active: no fault"))));
  fs::remove(folder / "config/telehug/passive.toml");  // nothing tells which: what is installed
  EXPECT_THAT(ask("", "ok").dump(), AllOf(HasSubstr("passive: no fault"), HasSubstr("active: no fault")));
}

TEST_F(Doctor, NamesAMissingPair) {
  expect("passive", "warn", "pairs", "no pair", "telehug pair invite");
}

}  // namespace
}  // namespace telehug
