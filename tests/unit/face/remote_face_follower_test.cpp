// SPDX-License-Identifier: Apache-2.0
#include "face/remote_face_follower.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>

namespace telehug {
namespace {

constexpr Duration look_interval = 125ms;

FoundFace face_at(double centre_x, double centre_y, double height, double score = 0.9) {
  return {.box = {centre_x - height * 0.36, centre_y - height / 2, height * 0.72, height}, .score = score};
}

// Looks at a screen of 1000 x 1000 px whose picture changes everywhere from look to look, unless it is still.
class Screen {
 public:
  explicit Screen(bool live = true, const RemoteFaceRules& rules = {}) : follower(rules, live) {}

  const std::optional<FollowedFace>& look(const FoundFaces& faces) {
    time += look_interval;
    if (!still) picture_.setTo(cv::Scalar::all(shade_ = (shade_ + 40) % 256));
    return follower.look(time, picture_, faces);
  }
  const std::optional<FollowedFace>& look_for(Duration duration, const FoundFaces& faces) {
    for (const Timestamp end = time + duration; time < end;)
      look(faces);
    return look(faces);
  }
  // Long enough for the rules to take any sure face.
  const std::optional<FollowedFace>& settle(const FoundFaces& faces) { return look_for(500ms, faces); }

  RemoteFaceFollower follower;
  Timestamp time = from_ns(5'000'000'000);
  bool still = false;

 private:
  cv::Mat picture_{1000, 1000, CV_8UC3, cv::Scalar(90, 90, 90)};
  int shade_ = 90;
};

double height_of(const std::optional<FollowedFace>& followed) {
  return followed ? followed->box.height : 0;
}

double middle_of(const std::optional<FollowedFace>& followed) {
  return followed ? followed->box.x + followed->box.width / 2 : 0;
}

TEST(RemoteFaceFollower, FollowsNobodyAmongNone) {
  Screen screen;
  EXPECT_FALSE(screen.settle({}));
  EXPECT_EQ(screen.follower.why_nobody(), NobodyFollowed::no_face);
}

TEST(RemoteFaceFollower, TakesAFaceThatWasSurelyFoundInTwoOfThreeLooks) {
  Screen screen;
  EXPECT_FALSE(screen.look({face_at(500, 400, 200)}));
  EXPECT_EQ(screen.follower.why_nobody(), NobodyFollowed::not_sure);
  EXPECT_FALSE(screen.look({face_at(500, 400, 200, 0.6)}));
  const auto& followed = screen.look({face_at(500, 400, 200)});
  ASSERT_TRUE(followed);
  EXPECT_EQ(followed->seen, screen.time);
}

TEST(RemoteFaceFollower, TakesAnUnsureFaceOnlyAfterASecond) {
  Screen screen;
  EXPECT_FALSE(screen.look_for(750ms, {face_at(500, 400, 200, 0.6)}));
  EXPECT_TRUE(screen.look_for(250ms, {face_at(500, 400, 200, 0.6)}));
}

TEST(RemoteFaceFollower, StartsTheSecondAnewAfterALookWithoutTheUnsureFace) {
  Screen screen;
  screen.look_for(750ms, {face_at(500, 400, 200, 0.6)});
  screen.look({});
  EXPECT_FALSE(screen.look_for(750ms, {face_at(500, 400, 200, 0.6)}));
}

TEST(RemoteFaceFollower, NeverTakesAFaceBelowTheLeastScore) {
  Screen screen;
  EXPECT_FALSE(screen.look_for(5s, {face_at(500, 400, 200, 0.49)}));
}

TEST(RemoteFaceFollower, NeverTakesAStillPictureOnALiveScreen) {
  Screen screen;
  screen.still = true;
  EXPECT_FALSE(screen.look_for(10s, {face_at(500, 400, 200, 0.99)}));
  EXPECT_EQ(screen.follower.why_nobody(), NobodyFollowed::still);
  screen.still = false;
  EXPECT_TRUE(screen.look_for(250ms, {face_at(500, 400, 200, 0.99)}));
}

TEST(RemoteFaceFollower, KeepsTheFollowedFaceWhileItSitsStill) {
  Screen screen;
  screen.settle({face_at(500, 400, 200)});
  screen.still = true;
  EXPECT_TRUE(screen.look_for(60s, {face_at(500, 400, 200, 0.55)}));
}

TEST(RemoteFaceFollower, TakesAStillPictureFromAFileAtOnceIfItIsSureEnough) {
  EXPECT_TRUE(Screen(false).look({face_at(500, 400, 200, 0.70)}));
  EXPECT_FALSE(Screen(false).look({face_at(500, 400, 200, 0.69)})) << "avatars and animals score up to there";
}

TEST(RemoteFaceFollower, TakesTheLargest) {
  Screen screen;
  const FoundFaces faces{face_at(250, 500, 150), face_at(500, 500, 200), face_at(750, 500, 199, 0.99)};
  EXPECT_DOUBLE_EQ(height_of(screen.settle(faces)), 200);
  EXPECT_EQ(screen.follower.others(), 2);
}

TEST(RemoteFaceFollower, LeavesOutTheOwnPictureInAnyCorner) {
  for (const double x : {150.0, 850.0}) {
    for (const double y : {150.0, 850.0}) {
      EXPECT_DOUBLE_EQ(height_of(Screen().settle({face_at(x, y, 250), face_at(500, 400, 200)})), 200);
      Screen alone;
      EXPECT_FALSE(alone.settle({face_at(x, y, 250)}));
      EXPECT_EQ(alone.follower.why_nobody(), NobodyFollowed::refused);
    }
  }
}

TEST(RemoteFaceFollower, TakesAFaceAtTheMiddleOfAnEdge) {
  EXPECT_TRUE(Screen().settle({face_at(500, 100, 200)}));
  EXPECT_TRUE(Screen().settle({face_at(100, 500, 200)}));
}

TEST(RemoteFaceFollower, LeavesOutFacesThatAreTooSmall) {
  EXPECT_FALSE(Screen().settle({face_at(500, 500, 69)}));
  EXPECT_TRUE(Screen().settle({face_at(500, 500, 71)}));
}

TEST(RemoteFaceFollower, KnowsAPersonWhoMovesAsTheSame) {
  Screen screen;
  const auto person = screen.settle({face_at(300, 400, 200)})->person;
  for (double x = 300; x <= 700; x += 80) {
    const auto& followed = screen.look({face_at(x, 400, 200 + (x - 300) / 10)});
    ASSERT_TRUE(followed);
    EXPECT_EQ(followed->person, person);
    EXPECT_DOUBLE_EQ(middle_of(followed), x);
  }
}

TEST(RemoteFaceFollower, HoldsALostFaceForTheHoldTime) {
  Screen screen;
  screen.settle({face_at(500, 400, 200)});
  const Timestamp seen = screen.time;
  const auto& held = screen.look_for(1250ms, {});
  ASSERT_TRUE(held);
  EXPECT_EQ(held->seen, seen);
  EXPECT_DOUBLE_EQ(height_of(held), 200);
  EXPECT_FALSE(screen.look_for(250ms, {}));
}

TEST(RemoteFaceFollower, KnowsAFaceThatComesBackInTimeAsTheSame) {
  Screen screen;
  const auto person = screen.settle({face_at(500, 400, 200)})->person;
  screen.look_for(1s, {});
  EXPECT_EQ(screen.look({face_at(510, 400, 200, 0.6)})->person, person);
}

TEST(RemoteFaceFollower, HoldsAndDropsTheFaceWhileNothingIsSeenOfTheScreen) {
  Screen screen;
  screen.settle({face_at(500, 400, 200)});
  EXPECT_TRUE(screen.follower.blind(screen.time + 1500ms));
  EXPECT_FALSE(screen.follower.blind(screen.time + 1501ms));
}

TEST(RemoteFaceFollower, SeesTheFaceInAPictureThatStandsStill) {
  Screen screen;
  screen.settle({face_at(500, 400, 200)});
  const auto& followed = screen.follower.unchanged(screen.time + 60s);
  ASSERT_TRUE(followed);
  EXPECT_EQ(followed->seen, screen.time + 60s);
}

TEST(RemoteFaceFollower, LetsTheHoldTimeRunWhileAPictureWithoutFaceStandsStill) {
  Screen screen;
  screen.settle({face_at(500, 400, 200)});
  const Timestamp seen = screen.time;
  screen.look({});
  EXPECT_TRUE(screen.follower.unchanged(seen + 1500ms));
  EXPECT_FALSE(screen.follower.unchanged(seen + 1501ms));
}

TEST(RemoteFaceFollower, FollowsAtOnceWhatAppearsElsewhereWhenTheFaceHasVanished) {
  Screen screen;
  const auto person = screen.settle({face_at(200, 400, 200)})->person;
  screen.look({face_at(800, 500, 120)});
  screen.look({face_at(800, 500, 120)});
  const auto& followed = screen.look({face_at(800, 500, 120)});
  ASSERT_TRUE(followed);
  EXPECT_NE(followed->person, person) << "so that the grid leaps there";
  EXPECT_DOUBLE_EQ(middle_of(followed), 800);
}

TEST(RemoteFaceFollower, FollowsAMovedFaceBackToWhereItWas) {
  Screen screen;
  screen.settle({face_at(200, 400, 200)});
  EXPECT_DOUBLE_EQ(middle_of(screen.look_for(750ms, {face_at(700, 400, 200)})), 700);
  EXPECT_DOUBLE_EQ(middle_of(screen.look_for(375ms, {face_at(200, 400, 200)})), 200);
}

TEST(RemoteFaceFollower, WaitsTheHoldTimeBeforeSomebodyWhoWasThereAllAlongIsFollowed) {
  Screen screen;
  screen.settle({face_at(300, 400, 200), face_at(700, 400, 190)});
  const Timestamp vanished = screen.time;
  while (screen.time - vanished < 1500ms)
    EXPECT_DOUBLE_EQ(middle_of(screen.look({face_at(700, 400, 190)})), 300);
  EXPECT_DOUBLE_EQ(middle_of(screen.look({face_at(700, 400, 190)})), 700);
}

TEST(RemoteFaceFollower, DoesNotTakeSomebodyElseForTheFollowedWhenBothWereGoneForAMoment) {
  Screen screen;
  screen.settle({face_at(300, 400, 200), face_at(700, 400, 190)});
  screen.look_for(600ms, {});
  for (int i = 0; i < 3; ++i)
    EXPECT_DOUBLE_EQ(middle_of(screen.look({face_at(700, 400, 190)})), 300) << "a frozen picture that comes back";
  EXPECT_DOUBLE_EQ(middle_of(screen.look({face_at(300, 400, 200), face_at(700, 400, 190)})), 300);
}

TEST(RemoteFaceFollower, KnowsNobodyAnyMoreAfterALongGapBetweenLooks) {
  Screen screen;
  screen.settle({face_at(500, 400, 200)});
  screen.time += 1h;
  screen.still = true;
  EXPECT_FALSE(screen.look_for(5s, {face_at(500, 400, 200, 0.56)})) << "an avatar where somebody was";
}

TEST(RemoteFaceFollower, KnowsNobodyAnyMoreAfterARest) {
  Screen screen;
  screen.settle({face_at(500, 400, 200)});
  screen.follower.rest();
  screen.still = true;
  EXPECT_FALSE(screen.look_for(5s, {face_at(500, 400, 200, 0.56)}));
}

TEST(RemoteFaceFollower, IsNotCarriedAwayByOneFalseFind) {
  Screen screen;
  screen.settle({face_at(300, 400, 200)});
  EXPECT_DOUBLE_EQ(middle_of(screen.look({face_at(700, 400, 400)})), 300);
  EXPECT_DOUBLE_EQ(middle_of(screen.look({face_at(301, 400, 200), face_at(700, 400, 400)})), 301);
}

TEST(RemoteFaceFollower, HandsOverToAClearlyLargerFaceAfterAWhile) {
  Screen screen;
  screen.settle({face_at(300, 400, 200)});
  EXPECT_DOUBLE_EQ(height_of(screen.look_for(1375ms, {face_at(300, 400, 200), face_at(700, 400, 250)})), 200);
  EXPECT_DOUBLE_EQ(height_of(screen.look_for(125ms, {face_at(300, 400, 200), face_at(700, 400, 250)})), 250);
}

TEST(RemoteFaceFollower, KeepsTheFaceBesideOneThatIsALittleLarger) {
  Screen screen;
  screen.settle({face_at(300, 400, 200)});
  EXPECT_DOUBLE_EQ(height_of(screen.look_for(10s, {face_at(300, 400, 200), face_at(700, 400, 249)})), 200);
}

TEST(RemoteFaceFollower, CountsOnlyAWhileInWhichTheOtherFaceStaysLarger) {
  Screen screen;
  screen.settle({face_at(300, 400, 200)});
  for (int i = 0; i < 5; ++i) {
    screen.look_for(1s, {face_at(300, 400, 200), face_at(700, 400, 260)});
    EXPECT_DOUBLE_EQ(height_of(screen.look({face_at(300, 400, 200), face_at(700, 400, 230)})), 200);
  }
}

TEST(RemoteFaceFollower, StartsAnewWhereAnotherPartOfTheScreenIsLookedAt) {
  Screen screen;
  screen.settle({face_at(500, 400, 200)});
  screen.follower.start_anew();
  EXPECT_FALSE(screen.look({face_at(500, 400, 200)}));
  EXPECT_TRUE(screen.settle({face_at(500, 400, 200)}));
}

TEST(RemoteFaceFollower, FollowsTheNextFaceToTheRightByHandAndStaysWithIt) {
  Screen screen;
  const FoundFaces faces{face_at(500, 400, 300), face_at(200, 400, 100), face_at(800, 400, 150)};
  screen.settle(faces);
  ASSERT_TRUE(screen.follower.next());
  EXPECT_DOUBLE_EQ(middle_of(screen.look_for(10s, faces)), 800) << "the larger one does not take over";
  ASSERT_TRUE(screen.follower.next());
  EXPECT_DOUBLE_EQ(middle_of(screen.look(faces)), 200) << "the leftmost after the rightmost";
  ASSERT_TRUE(screen.follower.next());
  EXPECT_DOUBLE_EQ(middle_of(screen.look(faces)), 500);
}

TEST(RemoteFaceFollower, HasNoNextFaceWhereThereIsOnlyOne) {
  Screen screen;
  EXPECT_FALSE(screen.follower.next());
  screen.settle({face_at(500, 400, 200), face_at(900, 900, 200)});
  EXPECT_FALSE(screen.follower.next()) << "the own picture is none";
}

TEST(RemoteFaceFollower, LetsSomebodyWhoSitsStillBeChosenByHand) {
  Screen screen;
  const FoundFaces faces{face_at(300, 400, 200), face_at(700, 400, 190)};
  screen.settle(faces);
  screen.still = true;
  screen.look_for(10s, faces);
  EXPECT_EQ(screen.follower.others(), 1);
  ASSERT_TRUE(screen.follower.next());
  EXPECT_DOUBLE_EQ(middle_of(screen.look(faces)), 700);
}

TEST(RemoteFaceFollower, CountsALargerFaceAnewAfterAPin) {
  Screen screen;
  screen.settle({face_at(300, 400, 200)});
  screen.look_for(1s, {face_at(300, 400, 200), face_at(700, 400, 300)});
  screen.follower.pin();
  screen.look_for(5s, {face_at(300, 400, 200), face_at(700, 400, 300)});
  screen.follower.unpin();
  EXPECT_DOUBLE_EQ(middle_of(screen.look_for(1s, {face_at(300, 400, 200), face_at(700, 400, 300)})), 300);
  EXPECT_DOUBLE_EQ(middle_of(screen.look_for(1s, {face_at(300, 400, 200), face_at(700, 400, 300)})), 700);
}

TEST(RemoteFaceFollower, StaysWithAPinnedFaceAndWaitsForItAtItsPlace) {
  Screen screen;
  EXPECT_FALSE(screen.follower.pin()) << "there is none yet";
  screen.settle({face_at(300, 400, 200)});
  ASSERT_TRUE(screen.follower.pin());
  EXPECT_DOUBLE_EQ(middle_of(screen.look_for(5s, {face_at(300, 400, 200), face_at(700, 400, 400)})), 300);
  EXPECT_FALSE(screen.look_for(5s, {face_at(700, 400, 400)}));
  EXPECT_EQ(screen.follower.why_nobody(), NobodyFollowed::refused);
  EXPECT_DOUBLE_EQ(middle_of(screen.settle({face_at(400, 500, 150), face_at(700, 400, 400)})), 400);
  screen.follower.unpin();
  EXPECT_DOUBLE_EQ(middle_of(screen.look_for(2s, {face_at(400, 500, 150), face_at(700, 400, 400)})), 700);
}

TEST(RemoteFaceFollower, BearsAnyFacesAtAnyTimes) {
  std::mt19937 random{7};
  const auto number = [&random](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  for (int run = 0; run < 20; ++run) {
    Screen screen(run % 2 == 0);
    for (int i = 0; i < 200; ++i) {
      FoundFaces faces;
      for (int count = static_cast<int>(number(0, 5)); count > 0; --count)
        faces.push_back(face_at(number(-200, 1200), number(-200, 1200), number(0, 900), number(0, 1)));
      const auto& followed = number(0, 1) < 0.8 ? screen.look(faces) : screen.follower.unchanged(screen.time += 125ms);
      if (number(0, 1) < 0.05) screen.follower.next();
      if (number(0, 1) < 0.05) screen.follower.pin();
      if (number(0, 1) < 0.05) screen.follower.unpin();
      if (followed) {
        EXPECT_LE(followed->seen, screen.time);
        EXPECT_LE(screen.time - followed->seen, RemoteFaceRules{}.hold);
        EXPECT_GT(followed->box.height, 0);
      }
    }
  }
}

}  // namespace
}  // namespace telehug
