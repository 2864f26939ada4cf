// SPDX-License-Identifier: Apache-2.0
#include "eval_face/face_scores.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using testing::HasSubstr;

const cv::Rect2d remote(400, 200, 72, 100);
const cv::Rect2d self(900, 800, 36, 50);
const LabelledPicture picture{.faces = {{remote, FaceRole::remote}, {self, FaceRole::self}}, .remote_view = {}};

FoundFace found(cv::Rect2d box, double dx, double dy, double scale = 1) {
  const cv::Point2d centre(box.x + box.width / 2 + dx, box.y + box.height / 2 + dy);
  const cv::Size2d size(box.width * scale, box.height * scale);
  return {.box = {centre.x - size.width / 2, centre.y - size.height / 2, size.width, size.height}, .score = 1};
}

FaceScores score(const LabelledPicture& label, const FoundFaces& faces, const std::optional<FoundFace>& picked) {
  FaceScores scores;
  scores.add(label, faces, picked ? std::optional(picked->box) : std::nullopt);
  return scores;
}

TEST(FaceScores, CountAFindThatFitsTheRemoteFace) {
  for (const FoundFace& near :
       {found(remote, 39, 0), found(remote, 0, -39), found(remote, 0, 0, 0.56), found(remote, 0, 0, 1.79)}) {
    const FaceScores scores = score(picture, {near}, near);
    EXPECT_EQ(scores.pictures_with_remote, 1);
    EXPECT_EQ(scores.remote_found, 1);
    EXPECT_EQ(scores.remote_picked, 1);
    EXPECT_EQ(scores.false_finds, 0);
  }
}

TEST(FaceScores, CountAFindThatFitsNoFaceAsFalse) {
  for (const FoundFace& off :
       {found(remote, 41, 0), found(remote, 0, 41), found(remote, 0, 0, 0.54), found(remote, 0, 0, 1.81)}) {
    const FaceScores scores = score(picture, {off}, off);
    EXPECT_EQ(scores.remote_found, 0);
    EXPECT_EQ(scores.remote_picked, 0);
    EXPECT_EQ(scores.false_finds, 1);
  }
}

TEST(FaceScores, DoNotCountTheOwnPictureAsPicked) {
  const FaceScores scores = score(picture, {found(remote, 0, 0), found(self, 0, 0)}, found(self, 0, 0));
  EXPECT_EQ(scores.remote_found, 1);
  EXPECT_EQ(scores.remote_picked, 0);
  EXPECT_EQ(scores.false_finds, 0);
}

TEST(FaceScores, TakeAnotherPersonOnlyInsideTheRemoteView) {
  const cv::Rect2d other(700, 200, 72, 100);
  LabelledPicture group{.faces = {{remote, FaceRole::remote}, {other, FaceRole::other}}, .remote_view = {}};
  EXPECT_EQ(score(group, {found(other, 0, 0)}, found(other, 0, 0)).remote_picked, 0);
  group.remote_view = cv::Rect2d(0, 0, 1280, 700);
  EXPECT_EQ(score(group, {found(other, 0, 0)}, found(other, 0, 0)).remote_picked, 1);
  group.remote_view = cv::Rect2d(0, 0, 600, 700);
  EXPECT_EQ(score(group, {found(other, 0, 0)}, found(other, 0, 0)).remote_picked, 0);
}

TEST(FaceScores, MeasureRightPicksInFaceHeights) {
  const FaceScores scores = score(picture, {}, found(remote, 5, 10, 1.2));
  ASSERT_EQ(scores.height_errors.size(), 1U);
  EXPECT_NEAR(scores.height_errors[0], 0.20, 1e-9);
  EXPECT_NEAR(scores.centre_x_errors[0], 0.05, 1e-9);
  EXPECT_NEAR(scores.chin_errors[0], 0.20, 1e-9) << "10 px lower and 20 px higher, half of that below the centre";
}

TEST(FaceScores, CountPicksWhereThereIsNoFace) {
  FaceScores scores;
  scores.add({}, {found(remote, 0, 0)}, remote);
  scores.add({}, {found(self, 0, 0)}, std::nullopt);
  EXPECT_EQ(scores.pictures_without_face, 2);
  EXPECT_EQ(scores.false_picks, 1);
  EXPECT_EQ(scores.pictures_with_remote, 0);
}

TEST(FaceScores, ReportCountsAndErrors) {
  FaceScores scores;
  scores.add(picture, {found(remote, 0, 0, 1.1)}, found(remote, 0, 0, 1.1).box);
  scores.add(picture, {}, std::nullopt);
  const std::string table = report(scores);
  EXPECT_THAT(table, testing::ContainsRegex("remote face picked +1 of 2\n"));
  EXPECT_THAT(table, testing::ContainsRegex("height +0.100 +0.100\n"));
  EXPECT_THAT(report({}), testing::Not(HasSubstr("errors")));
}

}  // namespace
}  // namespace telehug
