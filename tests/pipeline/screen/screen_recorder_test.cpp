// SPDX-License-Identifier: Apache-2.0
#include "screen/screen_recorder.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <opencv2/core.hpp>
#include <sstream>

#include "doubles/fake_clock.hpp"
#include "doubles/planned_screen_grabber.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/test_pictures.hpp"
#include "pictures/picture_file.hpp"
#include "screen/recorded_screen_grabber.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// As a full disk: no file may grow beyond that, and a write that begins before it ends there.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::uintmax_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

class ScreenRecorderTest : public testing::Test {
 protected:
  ScreenRecorderTest() { show(10); }

  void show(int shade) {
    const auto level = static_cast<uchar>(shade);
    grabber.picture.bgr = plain_picture(64, 48, {level, level, level});
    grabber.picture.monitor = {.width_px = 64, .height_px = 48};
    grabber.outcome = GrabOutcome::changed;
  }
  Status look(ScreenRecorder& recorder) {
    grabber.picture.time = clock.now();
    return recorder.look();
  }
  [[nodiscard]] std::size_t files() const {
    const std::filesystem::directory_iterator files(folder / "screen");
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }
  [[nodiscard]] std::string times() const {
    std::stringstream text;
    text << std::ifstream(folder / "screen_times.csv").rdbuf();
    return text.str();
  }
  static mode_t mode_of(const std::filesystem::path& path) {
    struct stat found {};
    EXPECT_EQ(::lstat(path.c_str(), &found), 0) << path;
    return found.st_mode & 07777;
  }

  TemporaryFolder folder;
  FakeClock clock;
  PlannedScreenGrabber grabber;
};

TEST_F(ScreenRecorderTest, ReplaysEachPictureAtItsTimeAndAtItsPlace) {
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  ASSERT_TRUE(recorder.begin());
  const std::vector<Duration> times{0ms, 125ms, 700ms, 8750ms};
  const Timestamp start = clock.now();
  std::vector<cv::Mat> pictures;
  for (std::size_t i = 0; i < times.size(); ++i) {
    clock.advance(start + times[i] - clock.now());
    grabber.picture.bgr = sloping_picture(64 + 2 * static_cast<int>(i), 48);
    grabber.picture.origin_px = {7 * static_cast<int>(i), 5};
    grabber.picture.monitor = {.width_px = 1280, .height_px = 1024};
    pictures.push_back(grabber.picture.bgr.clone());
    ASSERT_TRUE(look(recorder));
  }
  EXPECT_EQ(recorder.pictures(), 4);

  clock.advance(1h);
  RecordedScreenGrabber replay(folder.path(), clock);
  ASSERT_TRUE(replay.open());
  EXPECT_FALSE(replay.is_live());
  EXPECT_EQ(replay.name(), "recorded screen " + folder.path().string());
  const Timestamp opened = clock.now();
  ScreenPicture seen;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0) {
      clock.advance(opened + times[i] - 1ns - clock.now());
      EXPECT_EQ(replay.grab(seen), GrabOutcome::unchanged) << "one ns before picture " << i;
      EXPECT_EQ(seen.time, clock.now());
      clock.advance(1ns);
    }
    ASSERT_EQ(replay.grab(seen), GrabOutcome::changed) << "picture " << i;
    EXPECT_EQ(seen.time, clock.now());
    EXPECT_EQ(seen.origin_px, cv::Point(7 * static_cast<int>(i), 5));
    EXPECT_EQ(seen.monitor.width_px, 1280);
    EXPECT_EQ(seen.monitor.height_px, 1024);
    ASSERT_EQ(seen.bgr.size(), pictures[i].size());
    EXPECT_LE(cv::norm(seen.bgr, pictures[i], cv::NORM_INF), 12);
    EXPECT_LE(cv::norm(seen.bgr, pictures[i], cv::NORM_L1) / static_cast<double>(seen.bgr.total() * 3), 2);
  }
  clock.advance(1h);
  EXPECT_EQ(replay.grab(seen), GrabOutcome::unchanged) << "the last picture stays";
}

TEST_F(ScreenRecorderTest, WritesWhenEachPictureWasSeen) {
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  ASSERT_TRUE(recorder.begin());
  ASSERT_TRUE(look(recorder));
  clock.advance(1250ms);
  ASSERT_TRUE(look(recorder));
  EXPECT_EQ(times(),
            "frame,monotonic_ns,x_px,y_px,monitor_width_px,monitor_height_px\n"
            "00001,1000000000,0,0,64,48\n00002,2250000000,0,0,64,48\n");
  EXPECT_TRUE(std::filesystem::exists(folder / "screen/00001.jpg"));
  EXPECT_TRUE(std::filesystem::exists(folder / "screen/00002.jpg"));
}

TEST_F(ScreenRecorderTest, WritesNothingWhileTheScreenStandsStillOrIsLost) {
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  ASSERT_TRUE(recorder.begin());
  ASSERT_TRUE(look(recorder));
  for (const GrabOutcome outcome : {GrabOutcome::unchanged, GrabOutcome::lost, GrabOutcome::unchanged}) {
    clock.advance(1s);
    grabber.outcome = outcome;
    ASSERT_TRUE(look(recorder));
    EXPECT_EQ(recorder.problem(), outcome == GrabOutcome::lost ? "The screen is gone." : "");
  }
  EXPECT_EQ(recorder.pictures(), 1);
  EXPECT_EQ(files(), 1);
  clock.advance(1s);
  show(20);
  ASSERT_TRUE(look(recorder));
  EXPECT_EQ(recorder.pictures(), 2);
}

TEST_F(ScreenRecorderTest, LooksNoMoreOftenThanItsRate) {
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  ASSERT_TRUE(recorder.begin());
  EXPECT_EQ(recorder.next_look(), clock.now());
  for (int ms = 0; ms < 1000; ++ms, clock.advance(1ms))
    ASSERT_TRUE(look(recorder));
  EXPECT_EQ(recorder.pictures(), 8);
  EXPECT_EQ(recorder.next_look(), clock.now());
}

TEST_F(ScreenRecorderTest, TakesPicturesWithAnUndefinedFourthChannelAndParts) {
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  ASSERT_TRUE(recorder.begin());
  cv::Mat monitor(48, 64, CV_8UC4, cv::Scalar(200, 0, 0, 77));
  grabber.picture.bgr = monitor(cv::Rect(8, 8, 32, 16));
  grabber.picture.bgr.setTo(cv::Scalar(90, 120, 60, 5));
  ASSERT_TRUE(look(recorder));
  const auto written = read_picture(folder / "screen/00001.jpg");
  ASSERT_TRUE(written);
  EXPECT_LE(cv::norm(*written, plain_picture(32, 16, {90, 120, 60}), cv::NORM_INF), 3);
}

TEST_F(ScreenRecorderTest, LetsNobodyButTheOwnerReadIt) {
  const mode_t before = ::umask(0);
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  const Status begun = recorder.begin();
  const Status looked = look(recorder);
  ::umask(before);
  ASSERT_TRUE(begun);
  ASSERT_TRUE(looked);
  EXPECT_EQ(mode_of(folder / "screen"), 0700);
  EXPECT_EQ(mode_of(folder / "screen/00001.jpg"), 0600);
  EXPECT_EQ(mode_of(folder / "screen_times.csv"), 0600);
}

TEST_F(ScreenRecorderTest, RefusesAFolderThatHoldsAScreenAlready) {
  folder.write("screen/00001.jpg", "somebody else's");
  const Status begun = ScreenRecorder(grabber, folder.path(), 8, clock).begin();
  ASSERT_FALSE(begun);
  EXPECT_THAT(begun.error().message,
              AllOf(HasSubstr((folder / "screen").string()), HasSubstr("choose another folder")));
}

TEST_F(ScreenRecorderTest, FollowsNoLinkToWhatIsSomebodyElses) {
  folder.write("elsewhere", "untouched");
  std::filesystem::create_symlink(folder / "elsewhere", folder / "screen_times.csv");
  EXPECT_FALSE(ScreenRecorder(grabber, folder.path(), 8, clock).begin());
  EXPECT_EQ(std::filesystem::file_size(folder / "elsewhere"), 9);
}

TEST_F(ScreenRecorderTest, SaysWhereItCanNotWrite) {
  const auto absent = folder / "absent";
  const Status begun = ScreenRecorder(grabber, absent, 8, clock).begin();
  ASSERT_FALSE(begun);
  EXPECT_THAT(begun.error().message, AllOf(HasSubstr((absent / "screen").string() + " can't be written"),
                                           HasSubstr("choose a folder that you may write to")));
}

TEST_F(ScreenRecorderTest, SaysThatTheFolderHasGoneMeanwhile) {
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  ASSERT_TRUE(recorder.begin());
  std::filesystem::remove_all(folder / "screen");
  const Status looked = look(recorder);
  ASSERT_FALSE(looked);
  EXPECT_THAT(looked.error().message, HasSubstr("screen/00001.jpg"));
}

// What a full disk leaves must be replayable, whichever write it hits.
TEST_F(ScreenRecorderTest, KeepsWhatItHasWhenThereIsNoSpaceForAPicture) {
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  ASSERT_TRUE(recorder.begin());
  ASSERT_TRUE(look(recorder));
  clock.advance(1s);
  Status looked = Done{};
  {
    const FileSizeLimit limit(std::filesystem::file_size(folder / "screen/00001.jpg") / 2);
    looked = look(recorder);
  }
  ASSERT_FALSE(looked);
  EXPECT_THAT(looked.error().message, AllOf(HasSubstr("screen/00002.jpg"), HasSubstr("free some space on the disk")));
  EXPECT_EQ(files(), 1) << "no half of a picture stays";
  EXPECT_TRUE(RecordedScreenGrabber(folder.path(), clock).open());
  clock.advance(1s);
  ASSERT_TRUE(look(recorder));
  EXPECT_EQ(files(), 1) << "nothing is written after an error";
}

TEST_F(ScreenRecorderTest, KeepsWhatItHasWhenThereIsNoSpaceForItsTime) {
  ScreenRecorder recorder(grabber, folder.path(), 8, clock);
  ASSERT_TRUE(recorder.begin());
  std::string before;
  Status looked = Done{};
  do {  // until the table is larger than a picture
    before = times();
    clock.advance(1s);
    looked = look(recorder);
  } while (looked && times().size() < std::filesystem::file_size(folder / "screen/00001.jpg") + 100);
  ASSERT_TRUE(looked);
  before = times();
  clock.advance(1s);
  {
    const FileSizeLimit limit(before.size() + 10);
    looked = look(recorder);
  }
  ASSERT_FALSE(looked);
  EXPECT_THAT(looked.error().message, AllOf(HasSubstr("screen_times.csv"), HasSubstr("free some space on the disk")));
  EXPECT_EQ(times(), before) << "no half of a line stays";
  EXPECT_TRUE(RecordedScreenGrabber(folder.path(), clock).open());
}

TEST_F(ScreenRecorderTest, LeavesAReplayableRecordingWhereverItIsKilled) {
  {
    ScreenRecorder recorder(grabber, folder.path(), 8, clock);
    ASSERT_TRUE(recorder.begin());
    ASSERT_TRUE(look(recorder));
  }
  std::filesystem::copy_file(folder / "screen/00001.jpg", folder / "screen/00002.jpg");  // its line was not written
  folder.write("screen/00003.jpg.part", "half");
  RecordedScreenGrabber replay(folder.path(), clock);
  const Status opened = replay.open();
  ASSERT_TRUE(opened) << opened.error().message;
  ScreenPicture seen;
  EXPECT_EQ(replay.grab(seen), GrabOutcome::changed);
  clock.advance(1h);
  EXPECT_EQ(replay.grab(seen), GrabOutcome::unchanged);
}

}  // namespace
}  // namespace telehug
