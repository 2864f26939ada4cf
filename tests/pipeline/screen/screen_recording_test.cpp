// SPDX-License-Identifier: Apache-2.0
#include "screen/screen_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <thread>

#include "doubles/planned_screen_grabber.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/test_pictures.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

bool eventually(const auto& condition) {
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

class ScreenRecordingTest : public testing::Test {
 protected:
  std::unique_ptr<PlannedScreenGrabber> screen() {
    auto made = std::make_unique<PlannedScreenGrabber>();
    made->picture.bgr = plain_picture(64, 48, {10, 20, 30});
    made->picture.monitor = {.width_px = 64, .height_px = 48};
    return made;
  }
  [[nodiscard]] bool has(const char* name) const { return std::filesystem::exists(folder / "screen" / name); }

  TemporaryFolder folder;
  SteadyClock clock;
};

TEST_F(ScreenRecordingTest, WritesUntilItIsEnded) {
  ScreenRecording recording(screen(), folder.path(), 60, clock);
  ASSERT_TRUE(recording.open());
  EXPECT_EQ(recording.name(), "planned");
  EXPECT_FALSE(has("00001.jpg")) << "nothing before it has been said that something will be";
  recording.start();
  EXPECT_TRUE(eventually([&] { return has("00003.jpg"); }));
  EXPECT_FALSE(recording.failed());
  const auto pictures = recording.end();
  ASSERT_TRUE(pictures);
  EXPECT_GE(*pictures, 3);
  EXPECT_FALSE(has(fmt::format("{:05}.jpg", *pictures + 1).c_str()));
}

TEST_F(ScreenRecordingTest, LooksOnceHoweverShortItIs) {
  ScreenRecording recording(screen(), folder.path(), 1, clock);
  ASSERT_TRUE(recording.open());
  recording.start();
  const auto pictures = recording.end();
  ASSERT_TRUE(pictures);
  EXPECT_EQ(*pictures, 1);
}

TEST_F(ScreenRecordingTest, TellsAtOnceThatItCanWriteNoMore) {
  ScreenRecording recording(screen(), folder.path(), 60, clock);
  ASSERT_TRUE(recording.open());
  recording.start();
  ASSERT_TRUE(eventually([&] { return has("00001.jpg"); }));
  std::filesystem::rename(folder / "screen", folder / "elsewhere");
  EXPECT_TRUE(eventually([&] { return recording.failed(); }));
  const auto pictures = recording.end();
  ASSERT_FALSE(pictures);
  EXPECT_THAT(pictures.error().message, HasSubstr("can't be written"));
}

TEST_F(ScreenRecordingTest, SaysWhyThereIsNoPicture) {
  auto lost = screen();
  lost->outcome = GrabOutcome::lost;
  ScreenRecording recording(std::move(lost), folder.path(), 60, clock);
  ASSERT_TRUE(recording.open());
  recording.start();
  const auto pictures = recording.end();
  ASSERT_FALSE(pictures);
  EXPECT_EQ(pictures.error().message, "The screen is gone.");
}

TEST_F(ScreenRecordingTest, TakesAPictureThatALibraryCanNotBearForAnError) {
  auto odd = screen();
  odd->picture.bgr = cv::Mat(0, 0, CV_8UC4);
  ScreenRecording recording(std::move(odd), folder.path(), 60, clock);
  ASSERT_TRUE(recording.open());
  recording.start();
  EXPECT_TRUE(eventually([&] { return recording.failed(); }));
  EXPECT_FALSE(recording.end());
}

}  // namespace
}  // namespace telehug
