// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_offers.hpp"

#include <gmock/gmock.h>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::Field;

auto from(const std::string& source) {
  return Field(&OfferedCamera::source, source);
}

TEST(TheCamerasOnOffer, AreTheConfiguredOneAndThenTheOthers) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b", "c"})
    folder.write(std::string("usb-") + name + "-video-index0", "");
  const auto path = [&](const char* name) {
    return (folder / (std::string("usb-") + name + "-video-index0")).string();
  };
  CameraConfig config;
  config.device = path("b");
  EXPECT_THAT(offered_cameras(config, folder.path()),
              ElementsAre(from("webcam:" + path("b")), from("webcam:" + path("a")), from("webcam:" + path("c"))));
  config.source = "virtual";
  EXPECT_THAT(offered_cameras(config, folder.path()),
              ElementsAre(from("virtual"), from("webcam:" + path("a")), from("webcam:" + path("b")),
                          from("webcam:" + path("c"))));
}

TEST(TheCamerasOnOffer, HaveTheConfiguredOneAlsoWhenItIsNotPluggedIn) {
  const TemporaryFolder folder;
  CameraConfig config;
  config.device = "/dev/video7";
  EXPECT_THAT(offered_cameras(config, folder.path()), ElementsAre(from("webcam:/dev/video7")));
}

TEST(TheOffers, TellMonitorsWithTheirPlacesAndSizes) {
  const SizedMonitor monitor{
      {.name = "DP-1", .primary = true, .place_px = {1920, 0, 2560, 1440}}, {597, 336}, MonitorSizeFrom::edid};
  const auto offers = offers_json({{"virtual", "a camera"}}, {monitor});
  EXPECT_EQ(offers["cameras"][0], (nlohmann::json{{"source", "virtual"}, {"name", "a camera"}}));
  EXPECT_EQ(offers["monitors"][0], (nlohmann::json{{"name", "DP-1"},
                                                   {"primary", true},
                                                   {"x_px", 1920},
                                                   {"y_px", 0},
                                                   {"width_px", 2560},
                                                   {"height_px", 1440},
                                                   {"width_mm", 597.0},
                                                   {"height_mm", 336.0},
                                                   {"size_from", "edid"}}));
}

}  // namespace
}  // namespace telehug
