// SPDX-License-Identifier: Apache-2.0
//
// What a session does when things are missing; with somebody at a rig: tests/pipeline/setup.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "doubles/fake_clock.hpp"
#include "setup/calibration_session.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

SessionSettings settings() {
  SessionSettings wanted;
  wanted.screen = {380, 300, 1280, 1024};
  return wanted;
}

// Bezel and desk above a lit screen; a black triangle with its vertex on the screen's edge, if wanted.
cv::Mat drawn(int edge_row = 400, bool triangle = true, int light = 230) {
  cv::Mat bgr(720, 1280, CV_8UC3, cv::Scalar::all(90));
  cv::rectangle(bgr, {0, edge_row - 30, 1280, 30}, cv::Scalar::all(25), cv::FILLED);
  cv::rectangle(bgr, {0, edge_row, 1280, 720 - edge_row}, cv::Scalar::all(light), cv::FILLED);
  if (triangle) {
    const std::vector<cv::Point> corners{{630, edge_row}, {330, 719}, {930, 719}};
    cv::fillConvexPoly(bgr, corners, cv::Scalar::all(10), cv::LINE_AA);
  }
  return bgr;
}

class Sessions : public testing::Test {
 protected:
  void look(const cv::Mat& bgr, int frames = 1) {
    for (int i = 0; i < frames; ++i) {
      clock.advance(33ms);
      session.look(bgr, clock.now());
    }
  }
  [[nodiscard]] SetupStep step() const { return session.state().step; }
  [[nodiscard]] SetupAdvice advice() const { return session.state().advice; }

  FakeClock clock;
  CalibrationSession session{settings()};
};

TEST_F(Sessions, NeedTheScreensSizeAndPointsThatMakeACalibration) {
  EXPECT_THROW(CalibrationSession{SessionSettings{}}, std::invalid_argument);
  SessionSettings one = settings();
  one.points = {{100, 200}};
  EXPECT_THROW(CalibrationSession{one}, std::invalid_argument);
  SessionSettings thesis = settings();
  thesis.thesis = true;
  thesis.points = {{100, 200}, {150, 250}, {200, 200}};
  EXPECT_THROW(CalibrationSession{thesis}, std::invalid_argument);
}

TEST_F(Sessions, ShowTheBorderToBeConfirmedWhenTheTriangleIsSeen) {
  EXPECT_FALSE(session.confirm_border());
  look(drawn(), 25);
  ASSERT_EQ(step(), SetupStep::confirm_border);
  EXPECT_EQ(session.state().page, SetupPage::triangle);
  ASSERT_TRUE(session.state().border.has_value());
  EXPECT_NEAR(session.state().border->points_px[4].v_px, 400, 3);
  EXPECT_NEAR(session.state().border->vertex_px->u_px, 630, 6);
  EXPECT_TRUE(session.state().border->in_band);
  EXPECT_TRUE(session.confirm_border());
  EXPECT_EQ(step(), SetupStep::background);
  EXPECT_EQ(session.state().page, SetupPage::black);
}

TEST_F(Sessions, LookForTheBorderAgainWhenTheCameraIsTurned) {
  look(drawn(), 25);
  ASSERT_EQ(step(), SetupStep::confirm_border);
  look(drawn(440), 7);
  EXPECT_EQ(step(), SetupStep::bright);
  look(drawn(440), 25);
  EXPECT_EQ(step(), SetupStep::confirm_border);
  EXPECT_NEAR(session.state().border->points_px[4].v_px, 440, 3);
}

TEST_F(Sessions, LookForTheBorderAgainWhenItIsTheWrongOne) {
  EXPECT_FALSE(session.look_again());
  look(drawn(), 25);
  EXPECT_TRUE(session.look_again());
  EXPECT_EQ(step(), SetupStep::bright);
}

TEST_F(Sessions, TellWhereToTurnTheCamera) {
  look(drawn(640), 2);
  EXPECT_EQ(advice(), SetupAdvice::turn_towards_screen);
  EXPECT_FALSE(session.state().border->in_band);
}

TEST_F(Sessions, SayThatTheTriangleOrAnyEdgeIsNotSeen) {
  look(drawn(400, false), 3);
  EXPECT_EQ(advice(), SetupAdvice::no_triangle);
  EXPECT_EQ(step(), SetupStep::bright);
  CalibrationSession other{settings()};
  other.look(cv::Mat(720, 1280, CV_8UC3, cv::Scalar::all(120)), clock.now());
  EXPECT_EQ(other.state().advice, SetupAdvice::no_border);
}

TEST_F(Sessions, OfferAnotherLineWhenNoTriangleIsSeenForLong) {
  look(drawn(400, false), 130);
  EXPECT_EQ(step(), SetupStep::confirm_border);
  EXPECT_FALSE(session.state().border->vertex_px.has_value());
}

TEST_F(Sessions, DoNotGoOnWithoutAnyLine) {
  look(cv::Mat(720, 1280, CV_8UC3, cv::Scalar::all(120)), 300);
  EXPECT_EQ(step(), SetupStep::bright);
  EXPECT_EQ(advice(), SetupAdvice::no_border);
}

// A keyboard's edge, say: the screen is not in the picture.
TEST_F(Sessions, LookForTheBorderAgainWhenNothingBecomesBlackBelowALineWithoutTriangle) {
  look(drawn(400, false), 130);
  ASSERT_TRUE(session.confirm_border());
  look(drawn(400, false), 440);
  EXPECT_EQ(step(), SetupStep::background);
  look(drawn(400, false), 30);
  EXPECT_EQ(step(), SetupStep::bright);
  EXPECT_EQ(advice(), SetupAdvice::no_triangle);
}

TEST_F(Sessions, WaitForBlackAsLongAsOneLikesWhereTheTriangleWasSeen) {
  look(drawn(), 25);
  ASSERT_TRUE(session.confirm_border());
  look(drawn(), 900);
  EXPECT_EQ(step(), SetupStep::background);
}

TEST_F(Sessions, EndAlsoWhenTheyGoInCirclesForFiveMinutes) {
  SessionSettings alone = settings();
  alone.confirm_border = false;
  CalibrationSession circling{alone};
  int begun = 0;
  SetupStep before = SetupStep::bright;
  for (int i = 0; i < 5 * 60 * 5 + 130; ++i) {
    clock.advance(200ms);
    circling.look(drawn(400, false), clock.now());
    begun += before == SetupStep::background && circling.state().step == SetupStep::bright ? 1 : 0;
    before = circling.state().step;
  }
  EXPECT_GT(begun, 5);
  EXPECT_EQ(circling.state().step, SetupStep::cancelled);
  EXPECT_EQ(circling.state().advice, SetupAdvice::idle);
}

TEST_F(Sessions, SayThatItIsTooDark) {
  look(cv::Mat(720, 1280, CV_8UC3, cv::Scalar::all(12)), 200);
  EXPECT_EQ(advice(), SetupAdvice::too_dark);
  EXPECT_EQ(step(), SetupStep::bright);
}

TEST_F(Sessions, WaitUntilTheBlackPageIsSeen) {
  look(drawn(), 25);
  ASSERT_TRUE(session.confirm_border());
  look(drawn(), 60);
  EXPECT_EQ(advice(), SetupAdvice::page_not_seen);
  EXPECT_EQ(step(), SetupStep::background);
  look(drawn(400, false, 20), 32);
  EXPECT_EQ(step(), SetupStep::marks);
}

TEST_F(Sessions, WaitWhileSomethingMovesInTheBackground) {
  look(drawn(), 25);
  ASSERT_TRUE(session.confirm_border());
  for (int i = 0; i < 60; ++i) {
    cv::Mat hand = drawn(400, false, 20);
    cv::rectangle(hand, {20 * i, 200, 80, 250}, cv::Scalar(90, 120, 180), cv::FILLED);
    look(hand);
  }
  EXPECT_EQ(step(), SetupStep::background);
  EXPECT_EQ(advice(), SetupAdvice::hold_still);
}

TEST_F(Sessions, GoOnWithoutMarksThatAreNotSeen) {
  look(drawn(), 25);
  ASSERT_TRUE(session.confirm_border());
  look(drawn(400, false, 20), 32);
  ASSERT_EQ(step(), SetupStep::marks);
  look(drawn(400, false, 20), 20);
  EXPECT_EQ(advice(), SetupAdvice::page_not_seen);
  look(drawn(400, false, 20), 60);
  ASSERT_EQ(step(), SetupStep::dots);
  EXPECT_FALSE(session.state().camera_known);
  EXPECT_GE(session.state().dots.size(), 5U);
  EXPECT_FALSE(session.state().off_mm.has_value());
}

TEST_F(Sessions, SayAfterASecondThatTheCameraIsSilent) {
  look(drawn());
  clock.advance(900ms);
  session.no_picture(clock.now());
  EXPECT_NE(advice(), SetupAdvice::no_picture);
  clock.advance(200ms);
  session.no_picture(clock.now());
  EXPECT_EQ(advice(), SetupAdvice::no_picture);
  look(drawn());
  EXPECT_NE(advice(), SetupAdvice::no_picture);
}

TEST_F(Sessions, TakePicturesOfAnotherSizeOrKindForNone) {
  look(drawn(), 3);
  for (const cv::Mat& other :
       {cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(99)), cv::Mat(720, 1280, CV_8UC1), cv::Mat()}) {
    clock.advance(2s);
    session.look(other, clock.now());
    EXPECT_EQ(advice(), SetupAdvice::no_picture);
    EXPECT_EQ(session.state().image.width_px, 1280);
  }
}

TEST_F(Sessions, EndWhenNothingHappensForFiveMinutes) {
  look(drawn(), 25);
  clock.advance(4min);
  look(drawn());
  EXPECT_EQ(step(), SetupStep::confirm_border);
  clock.advance(2min);
  session.no_picture(clock.now());
  EXPECT_EQ(step(), SetupStep::cancelled);
  EXPECT_EQ(advice(), SetupAdvice::idle);
}

TEST_F(Sessions, AreOverWhenCancelled) {
  look(drawn(), 25);
  session.cancel();
  EXPECT_EQ(step(), SetupStep::cancelled);
  EXPECT_EQ(session.state().page, SetupPage::none);
  look(drawn(), 25);
  EXPECT_EQ(step(), SetupStep::cancelled);
  EXPECT_FALSE(session.confirm_border());
}

TEST_F(Sessions, GoBackAStep) {
  EXPECT_FALSE(session.back());
  look(drawn(), 25);
  ASSERT_TRUE(session.confirm_border());
  EXPECT_TRUE(session.back());
  EXPECT_EQ(step(), SetupStep::bright);
}

TEST_F(Sessions, SaveNothingThatIsNotSolved) {
  EXPECT_FALSE(session.calibrated().ok());
  const Status saved = session.save("/nonexistent/rig.toml");
  ASSERT_FALSE(saved.ok());
  EXPECT_THAT(saved.error().message, HasSubstr("not finished"));
  EXPECT_FALSE(session.repeat(0));
  EXPECT_FALSE(session.skip_dot());
}

TEST_F(Sessions, LeaveDotsOutButTwo) {
  look(drawn(), 25);
  ASSERT_TRUE(session.confirm_border());
  look(drawn(400, false, 20), 120);
  ASSERT_EQ(step(), SetupStep::dots);
  const std::size_t dots = session.state().dots.size();
  for (std::size_t i = 0; i + 2 < dots; ++i) {
    EXPECT_EQ(session.state().dot, i);
    EXPECT_TRUE(session.state().can_skip);
    EXPECT_TRUE(session.skip_dot());
  }
  EXPECT_FALSE(session.state().can_skip);
  EXPECT_FALSE(session.skip_dot());
  EXPECT_TRUE(session.repeat(0)) << "one that was left out can be touched after all";
  EXPECT_EQ(session.state().dot, 0U);
}

}  // namespace
}  // namespace telehug
