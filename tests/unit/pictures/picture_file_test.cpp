// SPDX-License-Identifier: Apache-2.0
#include "pictures/picture_file.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>

#include "doubles/temporary_folder.hpp"
#include "doubles/test_pictures.hpp"

namespace telehug {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(PictureFile, ReadsBackTheColoursOfAPngExactly) {
  const TemporaryFolder folder;
  const cv::Mat picture = sloping_picture(33, 17);
  ASSERT_TRUE(write_png(folder / "a.png", picture));
  const auto read = read_picture(folder / "a.png");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->type(), CV_8UC3);
  EXPECT_EQ(cv::norm(*read, picture, cv::NORM_INF), 0);
}

TEST(PictureFile, WritesOnePartOfAPicture) {
  const TemporaryFolder folder;
  const cv::Mat part = sloping_picture(40, 30)(cv::Rect(5, 6, 20, 10));
  ASSERT_TRUE(write_png(folder / "part.png", part));
  EXPECT_EQ(cv::norm(*read_picture(folder / "part.png"), part, cv::NORM_INF), 0);
}

TEST(PictureFile, WritesGreyPicturesThatReadAsEqualColours) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_png(folder / "grey.png", cv::Mat(4, 6, CV_8UC1, cv::Scalar(77))));
  EXPECT_EQ(read_picture(folder / "grey.png")->at<cv::Vec3b>(3, 5), cv::Vec3b(77, 77, 77));
}

TEST(PictureFile, TellsPngAndJpegByTheirContent) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_png(folder / "really_png.jpg", plain_picture(8, 8, {1, 2, 3})));
  ASSERT_TRUE(write_jpeg(folder / "really_jpeg.png", plain_picture(16, 8, {1, 2, 3})));
  EXPECT_EQ(read_picture(folder / "really_png.jpg")->cols, 8);
  EXPECT_EQ(read_picture(folder / "really_jpeg.png")->cols, 16);
}

TEST(PictureFile, LeavesNoUnfinishedFileBehind) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_png(folder / "a.png", plain_picture(8, 8, {1, 2, 3})));
  EXPECT_EQ(files_in(folder.path()), 1u);
  std::filesystem::create_directory(folder / "b.png");  // can't be replaced by a file
  EXPECT_FALSE(write_png(folder / "b.png", plain_picture(8, 8, {1, 2, 3})));
  EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(PictureFile, NamesTheFileAndTheReasonWhenItCantRead) {
  const TemporaryFolder folder;
  folder.write("text.jpg", "no picture");
  folder.write("cut.png", "\x89PNG\r\n\x1a\n and nothing more");
  for (const char* name : {"missing.jpg", "text.jpg", "cut.png"}) {
    const auto read = read_picture(folder / name);
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr(name));
  }
  EXPECT_THAT(read_picture(folder / "missing.jpg").error().message, HasSubstr("No such file"));
  EXPECT_THAT(read_picture(folder / "text.jpg").error().message, HasSubstr("neither a JPEG nor a PNG"));
  EXPECT_FALSE(read_picture(folder.path()));
}

TEST(PictureFile, RefusesToWriteWhatIsNoPicture) {
  const TemporaryFolder folder;
  EXPECT_FALSE(write_png(folder / "a.png", cv::Mat()));
  EXPECT_FALSE(write_png(folder / "a.png", cv::Mat(4, 4, CV_32FC3)));
  EXPECT_FALSE(write_jpeg(folder / "a.jpg", cv::Mat(4, 4, CV_8UC1)));
  EXPECT_FALSE(write_png("/nonexistent-folder/a.png", plain_picture(8, 8, {1, 2, 3})));
}

TEST(PictureReader, KeepsTheMemoryOfThePicture) {
  PictureReader reader;
  cv::Mat bgr;
  ASSERT_TRUE(reader.read(TELEHUG_FIXTURES "/rig1/background.jpg", bgr));
  const auto* data = bgr.data;
  ASSERT_TRUE(reader.read(TELEHUG_FIXTURES "/rig2/background.jpg", bgr));
  EXPECT_EQ(bgr.data, data);
  EXPECT_EQ(bgr.size(), cv::Size(1280, 720));
}

}  // namespace
}  // namespace telehug
