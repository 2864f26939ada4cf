// SPDX-License-Identifier: Apache-2.0
#include "calibration/screen_border.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace telehug {
namespace {

using testing::HasSubstr;

// What the camera sees: a desk, a bezel 20 px high, a screen below it, all along one inclined line.
class Scene {
 public:
  Scene(const BorderLine& border, int screen_grey)
      : border_(border), picture_(720, 1280, CV_8UC3, cv::Scalar::all(150)) {
    fill_below(-20, 40);
    fill_below(0, screen_grey);
  }

  // A triangle on the screen, vertex on its bottom edge, seen at a grazing angle: it opens downwards in the picture.
  Scene& triangle(double vertex_u) {
    const auto at = [&](double u, double row) { return cv::Point(cvRound(u), cvRound(border_.v_at(u) + row)); };
    cv::fillConvexPoly(picture_, std::vector{at(vertex_u, 0), at(vertex_u - 180, 90), at(vertex_u + 180, 90)},
                       cv::Scalar::all(5));
    return *this;
  }

  // A long dark stripe on the desk, longer than what is seen of the border.
  Scene& stripe(int v) {
    cv::rectangle(picture_, {0, v, 1280, 12}, cv::Scalar::all(60), cv::FILLED);
    return *this;
  }

  Scene& hide_border(int first_u, int last_u) {
    for (int u = first_u; u <= last_u; ++u)
      cv::line(picture_, {u, cvRound(border_.v_at(u)) - 60}, {u, cvRound(border_.v_at(u)) + 60},
               cv::Scalar(120, 150, 200));
    return *this;
  }

  [[nodiscard]] const cv::Mat& picture() const { return picture_; }

 private:
  void fill_below(double row, int grey) {
    for (int u = 0; u < picture_.cols; ++u)
      cv::line(picture_, {u, cvRound(border_.v_at(u) + row)}, {u, picture_.rows - 1}, cv::Scalar::all(grey));
  }

  BorderLine border_;
  cv::Mat picture_;
};

void expect_line(const Result<ScreenBorder>& found, const BorderLine& expected) {
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->line.v_at(0), expected.v_at(0), 2);
  EXPECT_NEAR(found->line.v_at(1279), expected.v_at(1279), 2);
}

TEST(ScreenBorder, IsTheLowestOfTheLongestLinesWithoutATriangle) {
  const BorderLine border{500, 0};
  expect_line(find_screen_border(Scene(border, 10).stripe(200).picture(), BorderChoice::longest), border);
}

TEST(ScreenBorder, IsFollowedWhenTheCameraRolls) {
  for (const double slope : {-0.07, -0.02, 0.03, 0.07}) {
    const BorderLine border{480 - 640 * slope, slope};
    expect_line(find_screen_border(Scene(border, 10).picture(), BorderChoice::longest), border);
  }
}

TEST(ScreenBorder, IsTheLineOnWhichTheTrianglesEdgesMeet) {
  for (const double slope : {-0.03, 0.0, 0.03}) {
    const BorderLine border{500 - 640 * slope, slope};
    // Partly hidden: the longest line is now another one.
    const Scene scene = Scene(border, 240).stripe(200).triangle(600).hide_border(900, 1250);
    expect_line(find_screen_border(scene.picture(), BorderChoice::triangle), border);
    const auto longest = find_screen_border(scene.picture(), BorderChoice::longest);
    ASSERT_TRUE(longest.ok());
    EXPECT_LT(longest->line.v_at(600), border.v_at(600) - 100);
  }
}

TEST(ScreenBorder, SaysThatTheTriangleIsMissing) {
  const auto found = find_screen_border(Scene({500, 0}, 240).picture(), BorderChoice::triangle);
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, HasSubstr("triangle"));
}

TEST(ScreenBorder, SaysThatThereIsNoLine) {
  for (const int grey : {0, 255}) {
    const cv::Mat picture(720, 1280, CV_8UC3, cv::Scalar::all(grey));
    const auto found = find_screen_border(picture, BorderChoice::longest);
    ASSERT_FALSE(found.ok());
    EXPECT_THAT(found.error().message, HasSubstr("no border"));
  }
  EXPECT_FALSE(find_screen_border(cv::Mat(), BorderChoice::longest).ok());
}

// A screen as light as the bezel and the desk about it: only the triangle is seen.
cv::Mat triangle_alone(const cv::Point& left, const cv::Point& vertex, const cv::Point& right, int desk = 170,
                       int triangle = 60) {
  cv::Mat picture(720, 1280, CV_8UC3, cv::Scalar::all(desk));
  cv::fillConvexPoly(picture, std::vector{vertex, left, {left.x, 719}, {right.x, 719}, right},
                     cv::Scalar::all(triangle));
  return picture;
}

TEST(TriangleAlone, IsFoundWhereNoLineMeetsIt) {
  const cv::Mat picture = triangle_alone({234, 719}, {652, 582}, {958, 719});
  EXPECT_FALSE(find_screen_border(picture, BorderChoice::triangle).ok());
  const auto found = find_screen_border(picture, BorderChoice::triangle_alone);
  ASSERT_TRUE(found.ok()) << found.error().message;
  ASSERT_TRUE(found->vertex.has_value());
  EXPECT_NEAR(found->vertex->u_px, 652, 3);
  EXPECT_NEAR(found->vertex->v_px, 582, 2);
  EXPECT_NEAR(found->line.v_at(652), 582, 2);
  EXPECT_EQ(found->length_px, 0);
}

TEST(TriangleAlone, IsFoundWhenOneOfItsEdgesIsLevel) {
  const auto found =
      find_screen_border(triangle_alone({0, 628}, {687, 486}, {1279, 521}), BorderChoice::triangle_alone);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->vertex->u_px, 687, 5);
  EXPECT_NEAR(found->vertex->v_px, 486, 2);
}

TEST(TriangleAlone, IsAsLevelAsTheLongestLineNearIt) {
  const BorderLine border{480 - 640 * 0.06, 0.06};
  const auto found = find_screen_border(Scene(border, 200).triangle(600).picture(), BorderChoice::triangle_alone);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->line.slope, 0.06, 0.005);
  EXPECT_NEAR(found->line.v_at(600), border.v_at(600), 2);
}

TEST(TriangleAlone, IsDarkerThanWhatIsBesideIt) {
  const auto found =
      find_screen_border(triangle_alone({234, 719}, {652, 582}, {958, 719}, 60, 170), BorderChoice::triangle_alone);
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, HasSubstr("no triangle found"));
}

TEST(LevelLines, CountOverlappingPiecesOnce) {
  for (const LevelLine& line : find_level_lines(Scene({500, 0.01}, 10).picture()))
    EXPECT_LE(line.length_px, 1280);
}

}  // namespace
}  // namespace telehug
