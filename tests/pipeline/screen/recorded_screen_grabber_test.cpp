// SPDX-License-Identifier: Apache-2.0
#include "screen/recorded_screen_grabber.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/test_pictures.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Four pictures of which the blue of number n is 10 n.
class RecordedScreenGrabberTest : public testing::Test {
 protected:
  RecordedScreenGrabberTest() {
    std::filesystem::create_directories(folder / "screen");
    for (int i = 1; i <= 4; ++i) {
      const auto blue = static_cast<uchar>(10 * i);
      EXPECT_TRUE(write_png(folder / ("screen/" + std::to_string(i) + ".png"), plain_picture(64, 48, {blue, 0, 0})));
    }
  }
  [[nodiscard]] std::string times_file() const { return (folder / "screen_times.csv").string(); }
  std::string faults_of(std::string_view csv) {
    folder.write("screen_times.csv", csv);
    const Status opened = replay.open();
    replay.close();
    return opened ? "" : opened.error().message;
  }

  TemporaryFolder folder;
  FakeClock clock;
  RecordedScreenGrabber replay{folder.path(), clock};
  ScreenPicture picture;
};

TEST_F(RecordedScreenGrabberTest, GivesALateLookerTheNewestPicture) {
  folder.write("screen_times.csv", "frame,monotonic_ns\n1,5000000000\n2,5100000000\n3,5250000000\n4,5300000000\n");
  ASSERT_TRUE(replay.open());
  std::vector<int> shown;
  for (int i = 0; i < 4; ++i, clock.advance(140ms)) {
    if (replay.grab(picture) == GrabOutcome::changed) shown.push_back(picture.bgr.at<cv::Vec3b>(0, 0)[0] / 10);
  }
  EXPECT_EQ(shown, (std::vector<int>{1, 2, 3, 4}));

  replay.close();
  ASSERT_TRUE(replay.open());
  clock.advance(260ms);
  ASSERT_EQ(replay.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.at<cv::Vec3b>(0, 0)[0], 30) << "begins anew, and leaves out what is over";
}

TEST_F(RecordedScreenGrabberTest, TakesAPictureWithoutAPlaceForTheWholeMonitor) {
  for (const char* csv :
       {"frame,monotonic_ns\n1,5\n", "monotonic_ns,frame,x_px,y_px,monitor_width_px,monitor_height_px\n5,1,,,,\n"}) {
    ASSERT_EQ(faults_of(csv), "");
    ASSERT_TRUE(replay.open());
    ASSERT_EQ(replay.grab(picture), GrabOutcome::changed);
    EXPECT_EQ(picture.origin_px, cv::Point(0, 0));
    EXPECT_EQ(picture.monitor.width_px, 64);
    EXPECT_EQ(picture.monitor.height_px, 48);
    EXPECT_EQ(picture.in_front, std::nullopt);
    replay.close();
  }
}

TEST_F(RecordedScreenGrabberTest, TellsAllFaultsOfTheTimesAtOnceWithTheirLines) {
  const std::string faults = faults_of(
      "frame,monotonic_ns\n1,5000\n9,6000\n2,soon\n3,7000\n\n4,7000\n../../etc/"
      "passwd,8000\n2,-1\n4\n1,99999999999999999999\n");
  const std::string file = times_file();
  EXPECT_EQ(faults, file + ":10: 1 values where the first line names 2 columns\n" +  // seen while it is split
                        file + ":3: there is no picture screen/9.jpg\n" +            //
                        file + ":4: monotonic_ns is 'soon', which is not a whole number\n" + file +
                        ":7: picture 4 is not later than the one before it\n" + file +
                        ":8: there is no picture screen/../../etc/passwd.jpg\n" + file +
                        ":9: the time -1 lies before the PC was started\n" + file +
                        ":11: monotonic_ns is '99999999999999999999', which is not a whole number");
}

TEST_F(RecordedScreenGrabberTest, RefusesTimesThatGoBack) {
  EXPECT_EQ(faults_of("frame,monotonic_ns\n1,9223372036854775807\n2,0\n"),
            times_file() + ":3: picture 2 is not later than the one before it");
}

TEST_F(RecordedScreenGrabberTest, RefusesPlacesThatAreNone) {
  const std::string head = "frame,monotonic_ns,x_px,y_px,monitor_width_px,monitor_height_px\n";
  const std::string file = times_file();
  EXPECT_EQ(faults_of(head + "1,1,0,0,0,48\n2,2,64,0,64,48\n3,3,0,-1,64,48\n4,4,0,0,99999,48\n1,5,0,,64,48\n"),
            file + ":2: a monitor of 0x48 px; both must be 1 to 32768\n" + file +
                ":3: 64,0 px is no place on a monitor of 64x48 px\n" + file +
                ":4: 0,-1 px is no place on a monitor of 64x48 px\n" + file +
                ":5: a monitor of 99999x48 px; both must be 1 to 32768\n" + file +
                ":6: y_px is '', which is not a whole number");
}

TEST_F(RecordedScreenGrabberTest, RefusesAnEmptyOrForeignTable) {
  const std::string file = times_file();
  EXPECT_EQ(faults_of("frame,monotonic_ns\n"), file + ":1: no picture is listed");
  EXPECT_THAT(faults_of(""), StartsWith(file + ":1: the file can't be read or is empty"));
  EXPECT_EQ(faults_of("picture,time\n1,5\n"),
            file + ":1: column 'frame' is missing\n" + file + ":1: column 'monotonic_ns' is missing");
  EXPECT_THAT(faults_of(std::string("\0\xFF\x80,\n,,,\0", 9)), HasSubstr(":1: column 'frame' is missing"));
  std::filesystem::remove(times_file());
  const Status opened = replay.open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, StartsWith(file + ":1: the file can't be read"));
  EXPECT_FALSE(replay.is_open());
}

TEST_F(RecordedScreenGrabberTest, SaysWhichPictureIsDamagedAndGoesOn) {
  folder.write("screen/2.png", "half a picture");
  ASSERT_EQ(faults_of("frame,monotonic_ns\n1,0\n2,1000000\n3,2000000\n"), "");
  ASSERT_TRUE(replay.open());
  ASSERT_EQ(replay.grab(picture), GrabOutcome::changed);
  clock.advance(1ms);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(replay.grab(picture), GrabOutcome::lost);
    EXPECT_THAT(replay.last_error(), HasSubstr("screen/2.png"));
  }
  clock.advance(1ms);
  EXPECT_EQ(replay.grab(picture), GrabOutcome::changed);
}

TEST_F(RecordedScreenGrabberTest, RefusesAPictureThatReachesPastItsMonitor) {
  ASSERT_EQ(faults_of("frame,monotonic_ns,x_px,y_px,monitor_width_px,monitor_height_px\n1,0,1,0,64,48\n"), "");
  ASSERT_TRUE(replay.open());
  EXPECT_EQ(replay.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(replay.last_error(), HasSubstr("(64x48 px at 1,0) reaches past its monitor of 64x48 px"));
}

TEST_F(RecordedScreenGrabberTest, GivesNothingWhileClosed) {
  EXPECT_EQ(replay.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(replay.last_error(), HasSubstr("is not open"));
}

}  // namespace
}  // namespace telehug
