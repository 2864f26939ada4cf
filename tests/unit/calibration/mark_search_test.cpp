// SPDX-License-Identifier: Apache-2.0
#include "calibration/mark_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "calibration/calibration_page.hpp"
#include "doubles/drawn_dots.hpp"

namespace telehug {
namespace {

const ScreenSize screen{380, 300, 1280, 1024};

RigCamera camera_of(ImageSize image, PictureOrientation orientation = {}) {
  return {{1000 * image.width_px / 1280.0, -0.03, {196, -8, 47}, 1.2, -0.8, 1.5}, image, orientation};
}

class TheMarks : public testing::Test {
 protected:
  static constexpr ImageSize image{1280, 720};
  const RigCamera camera = camera_of(image);
  const cv::Mat empty = DrawnDots(camera).picture(99);

  // Those whose dots lie within the picture.
  static std::vector<ScreenPoint> seen_by(const RigCamera& by) {
    std::vector<ScreenPoint> seen;
    for (const ScreenPoint& mark : mark_points(screen)) {
      const bool whole = by.sees({mark.x_mm - 9, mark.y_mm}) && by.sees({mark.x_mm + 9, mark.y_mm}) &&
                         by.sees({mark.x_mm, mark.y_mm - 7});
      if (whole) seen.push_back(mark);
    }
    return seen;
  }
  static DrawnDots drawn(const RigCamera& by, const std::vector<ScreenPoint>& dots) {
    DrawnDots page(by);
    for (const ScreenPoint& dot : dots)
      page.dot(dot);
    return page;
  }
  // As a calibration looks for them, which knows `roughly` at first.
  static std::vector<PointObservation> found(const cv::Mat& shown, const cv::Mat& empty, const RigCamera& roughly,
                                             const RigCamera& exactly) {
    const auto spots = lit_spots(shown, empty);
    const auto marks = marks_at(spots, screen, roughly);
    return measured_marks(shown, marks, screen, exactly);
  }
  [[nodiscard]] std::vector<PointObservation> found(const cv::Mat& shown) const {
    return found(shown, empty, camera, camera);
  }
  static void expect_exact(const std::vector<PointObservation>& marks, const RigCamera& by) {
    for (const PointObservation& mark : marks) {
      const ImagePoint truth = by.project(mark.screen).value();
      EXPECT_NEAR(mark.image.u_px, truth.u_px, 0.4) << mark.screen.x_mm << ", " << mark.screen.y_mm;
      EXPECT_NEAR(mark.image.v_px, truth.v_px, 0.4) << mark.screen.x_mm << ", " << mark.screen.y_mm;
    }
  }
};

TEST_F(TheMarks, LieFarApartOnScreensOfAllSizes) {
  for (const ScreenSize& size : {ScreenSize{300, 190, 0, 0}, {380, 300, 0, 0}, {700, 394, 0, 0}}) {
    const auto points = mark_points(size);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_GT(points[i].x_mm, calibration_dot_mm);
      EXPECT_LT(points[i].x_mm, size.width_mm - calibration_dot_mm);
      EXPECT_GT(points[i].y_mm, calibration_dot_mm);
      EXPECT_LT(points[i].y_mm, size.height_mm - calibration_dot_mm);
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT(std::hypot(points[i].x_mm - points[k].x_mm, points[i].y_mm - points[k].y_mm), 35);
    }
  }
}

TEST_F(TheMarks, AreFoundToPartsOfAPixelInPicturesOfAllSizes) {
  for (const ImageSize size : {ImageSize{640, 480}, {1280, 720}, {1920, 1080}}) {
    const RigCamera other = camera_of(size);
    const auto marks = found(drawn(other, mark_points(screen)).picture(), DrawnDots(other).picture(99), other, other);
    EXPECT_GE(marks.size(), seen_by(other).size()) << size.width_px;
    EXPECT_GE(marks.size(), 8U) << size.width_px;
    expect_exact(marks, other);
  }
}

TEST_F(TheMarks, AreToldApartByACameraThatIsSeveralMillimetresOff) {
  const RigCamera roughly{{960, 0, {190, -3, 45}, 1.4, 0.9, 2}, image};
  double off_mm = 0;
  for (const ScreenPoint& mark : seen_by(camera)) {
    const auto placed = roughly.screen_point(camera.project(mark).value()).value();
    off_mm = std::max(off_mm, std::hypot(placed.x_mm - mark.x_mm, placed.y_mm - mark.y_mm));
  }
  EXPECT_GT(off_mm, 8);
  const auto marks = found(drawn(camera, mark_points(screen)).picture(), empty, roughly, camera);
  // Those in the corners perhaps not.
  EXPECT_GE(marks.size() + 2, seen_by(camera).size());
  expect_exact(marks, camera);
}

TEST_F(TheMarks, AreFoundInPicturesThatAreMirroredOrUpsideDown) {
  for (const PictureOrientation& turned : {PictureOrientation{true, false}, {true, true}, {false, true}}) {
    const RigCamera other = camera_of(image, turned);
    const auto marks = found(drawn(other, mark_points(screen)).picture(), DrawnDots(other).picture(99), other, other);
    EXPECT_GE(marks.size(), seen_by(other).size()) << turned.name();
    expect_exact(marks, other);
  }
}

TEST_F(TheMarks, AreWithoutTheOneThatLiesElsewhere) {
  std::vector<ScreenPoint> dots = seen_by(camera);
  const ScreenPoint moved = dots[3];
  dots[3].x_mm += 12;
  const auto marks = found(drawn(camera, dots).picture());
  EXPECT_EQ(marks.size(), dots.size() - 1);
  EXPECT_TRUE(std::none_of(marks.begin(), marks.end(), [&](const auto& mark) { return mark.screen == moved; }));
  expect_exact(marks, camera);
}

TEST_F(TheMarks, AreWithoutWhatIsBrightAndNoDot) {
  std::vector<ScreenPoint> dots = seen_by(camera);
  const ScreenPoint hidden = dots[2];
  dots.erase(dots.begin() + 2);
  // A lamp's reflection right there.
  const auto marks = found(drawn(camera, dots).dot(hidden, {250, 250, 250}, 26).picture());
  EXPECT_EQ(marks.size(), dots.size());
  EXPECT_TRUE(std::none_of(marks.begin(), marks.end(), [&](const auto& mark) { return mark.screen == hidden; }));
  expect_exact(marks, camera);
}

TEST_F(TheMarks, AreNoneIfFewerThanFiveAreSeen) {
  std::vector<ScreenPoint> dots = seen_by(camera);
  dots.resize(4);
  EXPECT_TRUE(found(drawn(camera, dots).picture()).empty());
}

TEST_F(TheMarks, AreNotWhatIsThereWithoutThem) {
  const cv::Mat shown = drawn(camera, mark_points(screen)).picture();
  EXPECT_TRUE(lit_spots(shown, shown).empty());
  EXPECT_TRUE(lit_spots(empty, empty).empty());
}

}  // namespace
}  // namespace telehug
