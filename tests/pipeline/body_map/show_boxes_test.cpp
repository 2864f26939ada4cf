// SPDX-License-Identifier: Apache-2.0
#include "body_map/show_boxes.hpp"

#include <gmock/gmock.h>

#include "doubles/planned_face_finder.hpp"
#include "doubles/temporary_folder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

const cv::Vec3b grey(100, 100, 100);
const cv::Vec3b yellow(0, 255, 255);
const cv::Vec3b red(0, 0, 255);

// A face of 80 px in a picture of 500x400 px, chin at y = 140, middle at x = 250: 7 rows of boxes of 40 px.
class ShowBoxesTest : public testing::Test {
 protected:
  ShowBoxesTest() {
    options.picture = folder / "chat.png";
    options.out = folder / "boxes.png";
    EXPECT_TRUE(write_png(options.picture, cv::Mat(400, 500, CV_8UC3, cv::Scalar(grey))));
  }
  [[nodiscard]] cv::Vec3b drawn(int x, int y) const {
    const auto picture = read_picture(options.out);
    return picture ? picture->at<cv::Vec3b>(y, x) : cv::Vec3b();
  }

  TemporaryFolder folder;
  ShowBoxesOptions options;
  PlannedFaceFinder finder{{{.box = {220, 60, 60, 80}, .score = 1}}};
};

TEST_F(ShowBoxesTest, DrawsTheFaceInYellowAndTheBoxesInRed) {
  const auto shown = show_boxes(options, finder);
  ASSERT_TRUE(shown) << shown.error().message;
  EXPECT_EQ(shown->grid, (GridShape{.columns = 5, .rows = 7}));
  EXPECT_EQ(shown->face, cv::Rect2d(220, 60, 60, 80));
  EXPECT_EQ(shown->touched, 0);
  EXPECT_EQ(drawn(250, 60), yellow) << "hairline";
  EXPECT_EQ(drawn(220, 100), yellow) << "cheek";
  EXPECT_EQ(drawn(170, 140), red) << "top of box 1";
  EXPECT_EQ(drawn(150, 160), red) << "left of box 1";
  EXPECT_EQ(drawn(230, 225), red) << "between boxes 12 and 13";
  EXPECT_EQ(drawn(155, 145), grey) << "inside box 1, beside its number";
  EXPECT_EQ(drawn(20, 20), grey);
}

TEST_F(ShowBoxesTest, FillsTheTouchedBox) {
  options.touched = 8;
  const auto shown = show_boxes(options, finder);
  ASSERT_TRUE(shown) << shown.error().message;
  EXPECT_EQ(shown->touched, 8);
  EXPECT_GT(drawn(235, 185)[2], 150) << "inside box 8, beside its number";
  EXPECT_EQ(drawn(195, 185), grey) << "inside box 7";
}

TEST_F(ShowBoxesTest, FillsTheBoxUnderAPoint) {
  options.touched_px = cv::Point2d(250, 200);
  const auto shown = show_boxes(options, finder);
  ASSERT_TRUE(shown) << shown.error().message;
  EXPECT_EQ(shown->touched, 8);

  options.touched_px = cv::Point2d(20, 20);
  EXPECT_EQ(show_boxes(options, finder)->touched, 0);
}

TEST_F(ShowBoxesTest, DrawsWhereTheGridReachesPastThePicture) {
  finder.faces = FoundFaces{{.box = {10, 150, 60, 80}, .score = 1}};
  options.touched = 3;
  const auto shown = show_boxes(options, finder);
  ASSERT_TRUE(shown) << shown.error().message;
  EXPECT_EQ(shown->touched, 3);
  options.touched = 1;
  const auto beside = show_boxes(options, finder);
  ASSERT_FALSE(beside);
  EXPECT_THAT(beside.error().message, HasSubstr("Box 1 lies beside the picture"));
}

TEST_F(ShowBoxesTest, EndsTheGridAtTheViewsBottom) {
  options.view = cv::Rect(100, 50, 300, 150);
  finder.faces = FoundFaces{{.box = {120, 10, 60, 80}, .score = 1}};  // in the view: (220, 60) of the picture
  const auto shown = show_boxes(options, finder);
  ASSERT_TRUE(shown) << shown.error().message;
  EXPECT_EQ(shown->face, cv::Rect2d(220, 60, 60, 80));
  EXPECT_EQ(shown->grid.rows, 2);
  EXPECT_EQ(finder.last_size, cv::Size(300, 150));
  EXPECT_EQ(drawn(170, 199), red);
  EXPECT_EQ(drawn(150, 210), grey);
}

TEST_F(ShowBoxesTest, SaysWhyNothingCanBeShown) {
  options.touched = 36;
  const auto no_box = show_boxes(options, finder);
  ASSERT_FALSE(no_box);
  EXPECT_THAT(no_box.error().message, HasSubstr("1 to 35"));

  finder.faces = FoundFaces{};
  const auto no_face = show_boxes(options, finder);
  ASSERT_FALSE(no_face);
  EXPECT_THAT(no_face.error().message, HasSubstr("chat.png: No face"));
  EXPECT_FALSE(std::filesystem::exists(options.out));

  options.picture = folder / "absent.png";
  EXPECT_FALSE(show_boxes(options, finder));
}

TEST_F(ShowBoxesTest, SaysThatThePictureCanNotBeWritten) {
  options.out = folder / "absent" / "boxes.png";
  const auto shown = show_boxes(options, finder);
  ASSERT_FALSE(shown);
  EXPECT_THAT(shown.error().message, HasSubstr("boxes.png"));
}

}  // namespace
}  // namespace telehug
