// SPDX-License-Identifier: Apache-2.0
#include "screen/picture_grabber.hpp"

#include <gmock/gmock.h>

#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

// A picture of one colour; `shade` tells it from the others.
std::filesystem::path write_picture(const TemporaryFolder& folder, std::string_view name, int shade,
                                    cv::Size size = {64, 48}) {
  const Status written = write_png(folder / name, cv::Mat(size, CV_8UC3, cv::Scalar(shade, shade, shade)));
  EXPECT_TRUE(written) << written.error().message;
  return folder / name;
}

int shade_of(const ScreenPicture& picture) {
  return picture.bgr.at<cv::Vec3b>(0, 0)[0];
}

class PictureGrabberTest : public testing::Test {
 protected:
  TemporaryFolder folder;
  FakeClock clock;
  ScreenPicture picture;
};

TEST_F(PictureGrabberTest, GivesAPictureOnceAndThenSaysThatItStandsStill) {
  PictureGrabber grabber({.path = write_picture(folder, "a.png", 10), .view = {}}, clock);
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(shade_of(picture), 10);
  EXPECT_EQ(picture.origin_px, cv::Point(0, 0));
  EXPECT_EQ(picture.monitor.width_px, 64);
  EXPECT_EQ(picture.monitor.height_px, 48);
  EXPECT_EQ(picture.time, clock.now());

  clock.advance(125ms);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
  EXPECT_EQ(picture.time, clock.now());
  EXPECT_EQ(shade_of(picture), 10);
}

TEST_F(PictureGrabberTest, NoticesThatTheFileWasWrittenAnew) {
  const auto file = write_picture(folder, "a.png", 10);
  PictureGrabber grabber({.path = file, .view = {}}, clock);
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);

  write_picture(folder, "a.png", 20);
  std::filesystem::last_write_time(file, std::filesystem::file_time_type(1000s));  // whatever the clock of the disk
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(shade_of(picture), 20);

  write_picture(folder, "a.png", 30, {640, 480});
  std::filesystem::last_write_time(file, std::filesystem::file_time_type(1000s));
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed) << "another size at the same time";
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
}

TEST_F(PictureGrabberTest, SaysWhatIsLostAndGetsItBack) {
  const auto file = write_picture(folder, "a.png", 10);
  PictureGrabber grabber({.path = file, .view = {}}, clock);
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(grabber.last_error(), "");

  std::filesystem::rename(file, folder / "aside.png");
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(grabber.last_error(), HasSubstr("a.png can't be read"));

  folder.write("a.png", "half a picture");
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(grabber.last_error(), HasSubstr("a.png"));

  std::filesystem::rename(folder / "aside.png", file);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(shade_of(picture), 10);
}

TEST_F(PictureGrabberTest, ShowsAFolderInOrderOfNamesAtItsRateOverAndOver) {
  write_picture(folder, "2.png", 20);
  write_picture(folder, "1.PNG", 10);
  write_picture(folder, "3.png", 30);
  folder.write("labels.csv", "no picture");
  PictureGrabber grabber({.path = folder.path(), .rate_hz = 4, .view = {}}, clock);
  ASSERT_TRUE(grabber.open());
  std::vector<int> shades;
  for (int i = 0; i < 8; ++i, clock.advance(125ms)) {
    if (grabber.grab(picture) == GrabOutcome::changed) {
      shades.push_back(shade_of(picture));
    }
  }
  EXPECT_EQ(shades, (std::vector<int>{10, 20, 30, 10}));
}

TEST_F(PictureGrabberTest, LooksOnlyAtTheView) {
  PictureGrabber grabber({.path = write_picture(folder, "a.png", 10), .view = cv::Rect(20, 30, 30, 10)}, clock);
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(30, 10));
  EXPECT_EQ(picture.origin_px, cv::Point(20, 30));
  EXPECT_EQ(picture.monitor.width_px, 64);
}

TEST_F(PictureGrabberTest, CutsAViewThatReachesPastThePicture) {
  constexpr int far = std::numeric_limits<int>::max();
  PictureGrabber grabber({.path = write_picture(folder, "a.png", 10), .view = cv::Rect(-5, 40, far, far)}, clock);
  ASSERT_TRUE(grabber.open());
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(64, 8));
  EXPECT_EQ(picture.origin_px, cv::Point(0, 40));
}

TEST_F(PictureGrabberTest, RefusesAViewOutsideOfThePicture) {
  const auto file = write_picture(folder, "a.png", 10);
  for (const cv::Rect& view : {cv::Rect(64, 0, 10, 10), cv::Rect(0, 0, 0, 0), cv::Rect(5, 5, -3, 4)}) {
    PictureGrabber grabber({.path = file, .view = view}, clock);
    ASSERT_TRUE(grabber.open());
    EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
    EXPECT_THAT(grabber.last_error(), HasSubstr("outside of the picture"));
  }
}

TEST_F(PictureGrabberTest, OpensOnlyWhatIsThere) {
  PictureGrabber absent({.path = folder / "absent.png", .view = {}}, clock);
  const Status opened = absent.open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("absent.png"));
  EXPECT_FALSE(absent.is_open());

  PictureGrabber empty({.path = folder.path(), .view = {}}, clock);
  EXPECT_FALSE(empty.open());
  write_picture(folder, "a.png", 10);
  EXPECT_TRUE(empty.open()) << "later, when there is a picture";

  PictureGrabber still({.path = folder.path(), .rate_hz = 0, .view = {}}, clock);
  EXPECT_FALSE(still.open());
}

TEST_F(PictureGrabberTest, GivesNothingWhileClosedAndAllAfterOpeningAgain) {
  PictureGrabber grabber({.path = write_picture(folder, "a.png", 10), .view = {}}, clock);
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  ASSERT_TRUE(grabber.open());
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
  grabber.close();
  grabber.close();
  EXPECT_FALSE(grabber.is_open());
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::lost);
  ASSERT_TRUE(grabber.open());
  EXPECT_EQ(grabber.grab(picture), GrabOutcome::changed);
}

}  // namespace
}  // namespace telehug
