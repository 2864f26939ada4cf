// SPDX-License-Identifier: Apache-2.0
//
// `telehug doctor` on what is broken of the parent's side: camera, light, calibration, monitor, desktop.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <opencv2/core.hpp>

#include "doubles/private_bus.hpp"
#include "doubles/xvfb.hpp"
#include "integration/ctl/broken_pc.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;

class BrokenDesktop : public BrokenPc {
 protected:
  // The screen is this desktop's, and not a picture.
  void watch_the_screen() const { configure("active", ""); }
};

// What a Wayland compositor listens on.
class ListeningSocket {
 public:
  explicit ListeningSocket(const fs::path& path) : fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 || ::listen(fd_, 4) != 0)
      throw std::runtime_error("nobody can listen on " + path.string());
  }
  ~ListeningSocket() { ::close(fd_); }
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

 private:
  int fd_;
};

TEST_F(BrokenDesktop, AMissingCameraIsNamed) {
  fs::remove(root() / "dev/video0");
  expect("active", {"no camera", "fail", "camera", "there is no webcam", "plug it in"});
}

TEST_F(BrokenDesktop, ACameraWithoutRightsIsNamedWithTheGroupAndTheUser) {
  fs::permissions(root() / "dev/video0", fs::perms::none);
  as_nobody = true;
  expect("active",
         {"camera without rights", "fail", "camera", "/dev/video0 may not be used", "sudo usermod -aG video "});
}

TEST_F(BrokenDesktop, ACameraInTheDarkIsNamed) {
  for (const char* name : {"1.png", "2.png", "3.png"})
    ASSERT_TRUE(write_png(root() / name, cv::Mat(120, 160, CV_8UC3, cv::Scalar(9, 8, 7))));
  configure("active", "[body_map]\npicture = \"chat.jpg\"\n[camera]\nsource = \"replay:" + root().string() + "\"\n");
  expect("active", {"camera in the dark", "warn", "light", "picture is dark: 3 %", "turn on a light"});
}

TEST_F(BrokenDesktop, ACameraThatIsDazzledIsNamed) {
  cv::Mat dazzled(120, 160, CV_8UC3, cv::Scalar(90, 90, 90));
  dazzled.colRange(0, 80).setTo(cv::Scalar(255, 255, 255));
  ASSERT_TRUE(write_png(root() / "1.png", dazzled));
  configure("active", "[body_map]\npicture = \"chat.jpg\"\n[camera]\nsource = \"replay:" + root().string() + "\"\n");
  expect("active", {"camera dazzled", "warn", "light", "50 % of the camera's picture are blown out", "camera tune"});
}

TEST_F(BrokenDesktop, AMissingCalibrationIsNamedWithTheMonitorsSize) {
  fs::remove(state() / "rig.toml");
  expect("active", {"calibration missing", "fail", "calibration", "no calibration at",
                    "telehug-active calibrate --width-mm 520 --height-mm 290"});
}

TEST_F(BrokenDesktop, ACalibrationForOtherPicturesIsNamed) {
  write("state/telehug/rig.toml",
        "[image]\nwidth_px = 640\nheight_px = 480\n[screen]\nwidth_mm = 521\nheight_mm = 291\n");
  expect("active", {"calibration of another resolution", "fail", "calibration", "pictures of 640 x 480 px",
                    "set camera.width_px = 640 and camera.height_px = 480"});
}

TEST_F(BrokenDesktop, ACalibrationOfAnotherMonitorIsNamed) {
  write("state/telehug/rig.toml", "[screen]\nwidth_mm = 380\nheight_mm = 300\n");
  expect("active", {"calibration of another monitor", "warn", "calibration", "380 x 300 mm", "--width-mm 520"});
}

TEST_F(BrokenDesktop, AMonitorThatDoesNotTellItsSizeIsNamed) {
  fs::remove(root() / "sys/class/drm/card0-DP-1/edid");
  fs::remove(state() / "rig.toml");
  expect("active", {"monitor's size unknown", "fail", "calibration", "no calibration at", "with a ruler"});
}

TEST_F(BrokenDesktop, AnXServerThatIsNotThereIsNamedAndOneThatIsThereIsNot) {
  watch_the_screen();
  Xvfb server;
  set("DISPLAY=" + server.display());
  server.stop();
  expect("active",
         {"X server gone", "fail", "screen", "no X server answers as DISPLAY=" + server.display(), "correct DISPLAY"});
  server.start();
  expect("active", {"", "ok", "screen", "an X11 desktop", ""});
}

TEST_F(BrokenDesktop, AWaylandDesktopWithoutPortalIsNamed) {
  watch_the_screen();
  const PrivateBus bus;
  const ListeningSocket compositor(runtime() / "wayland-0");
  set("WAYLAND_DISPLAY=wayland-0");
  set("DBUS_SESSION_BUS_ADDRESS=" + bus.address());
  expect("active", {"Wayland without portal", "fail", "screen", "there is no xdg-desktop-portal",
                    "apt install pipewire wireplumber xdg-desktop-portal"});
}

TEST_F(BrokenDesktop, ASessionWithoutDesktopIsNamed) {
  watch_the_screen();
  expect("active", {"no desktop", "fail", "screen", "no desktop", "session of the person"});
}

}  // namespace
}  // namespace telehug
