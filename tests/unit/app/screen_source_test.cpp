// SPDX-License-Identifier: Apache-2.0
#include "screen_source.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

class ScreenSourceTest : public testing::Test {
 protected:
  ScreenSourceTest() { unsetenv("WAYLAND_DISPLAY"); }
  ~ScreenSourceTest() override { unsetenv("WAYLAND_DISPLAY"); }

  [[nodiscard]] std::string name_of_the_grabber() const {
    const auto grabber = make_screen_grabber(config, clock);
    return grabber ? (*grabber)->name() : grabber.error().message;
  }

  ActiveConfig config;
  FakeClock clock;
};

TEST_F(ScreenSourceTest, IsTheScreenOfThisSessionUnlessAPictureIsSet) {
  EXPECT_THAT(name_of_the_grabber(), HasSubstr("X11"));
  setenv("WAYLAND_DISPLAY", "wayland-0", 1);
  EXPECT_THAT(name_of_the_grabber(), HasSubstr("shared by the desktop"));
  config.body_map.picture = "chat.jpg";
  EXPECT_EQ(name_of_the_grabber(), "picture chat.jpg");
}

TEST_F(ScreenSourceTest, IsWhatTheConfigurationSays) {
  config.body_map.picture = "chat.jpg";
  for (const auto& [source, name] :
       std::vector<std::pair<std::string, std::string>>{{"x11", "X11"},
                                                        {"portal", "shared by the desktop"},
                                                        {"camera:/dev/video7", "/dev/video7"},
                                                        {"replay:/a/b", "/a/b"},
                                                        {"picture", "chat.jpg"}}) {
    config.body_map.source = source;
    EXPECT_THAT(name_of_the_grabber(), HasSubstr(name)) << source;
  }
}

TEST_F(ScreenSourceTest, AsksForThePictureThatIsMissing) {
  config.body_map.source = "picture";
  EXPECT_THAT(name_of_the_grabber(), HasSubstr("body_map.picture"));
}

TEST_F(ScreenSourceTest, PinsAWindowOnlyOnX11AndSaysSo) {
  config.body_map.window = "chat";
  EXPECT_TRUE((*make_screen_grabber(config, clock))->pins_window());
  EXPECT_EQ(ignored_screen_keys(config.body_map), "");
  config.body_map.source = "portal";
  EXPECT_FALSE((*make_screen_grabber(config, clock))->pins_window());
  EXPECT_THAT(ignored_screen_keys(config.body_map), HasSubstr("window"));
  config.body_map.window.clear();
  EXPECT_EQ(ignored_screen_keys(config.body_map), "");
}

}  // namespace
}  // namespace telehug
