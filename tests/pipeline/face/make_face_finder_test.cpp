// SPDX-License-Identifier: Apache-2.0
#include "face/make_face_finder.hpp"

#include <gmock/gmock.h>

#include <utility>

#include "doubles/largest_face.hpp"
#include "doubles/temporary_folder.hpp"
#include "eval_face/face_labels.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

TEST(MakeFaceFinder, TakesHaarAndSaysSoWhereTheModelCannotBeUsed) {
  const TemporaryFolder folder;
  const auto chosen = make_face_finder("blaze", {folder.write("wrong.onnx", "not a model")});
  ASSERT_TRUE(chosen) << chosen.error().message;
  EXPECT_EQ(chosen->finder->name(), "Haar");
  EXPECT_THAT(chosen->note, HasSubstr("wrong.onnx"));
  EXPECT_THAT(chosen->note, HasSubstr("Haar"));
}

TEST(MakeFaceFinder, MakesTheOneThatIsAskedFor) {
  EXPECT_EQ(make_face_finder("blaze")->finder->name(), "BlazeFace");
  EXPECT_EQ(make_face_finder("blaze")->note, "");
  EXPECT_EQ(make_face_finder("haar")->finder->name(), "Haar");
  EXPECT_EQ(make_face_finder("haar")->note, "");
}

// How exact a finder is on the labelled pictures, in heights of the face.
struct Exactness {
  const char* finder;
  double height, middle, chin;
};

class AnyFaceFinder : public testing::TestWithParam<Exactness> {
 protected:
  std::unique_ptr<FaceFinder> finder = std::move(make_face_finder(GetParam().finder)->finder);
};

TEST_P(AnyFaceFinder, FindsNothingInAnEmptyOrUniformPicture) {
  for (const cv::Mat& picture :
       {cv::Mat(), cv::Mat(0, 0, CV_8UC3), cv::Mat(1, 1, CV_8UC3, cv::Scalar(9, 9, 9)),
        cv::Mat(1, 4000, CV_8UC3, cv::Scalar(9, 9, 9)), cv::Mat(4000, 1, CV_8UC3, cv::Scalar(9, 9, 9)),
        cv::Mat(480, 640, CV_8UC3, cv::Scalar(90, 120, 90))}) {
    const auto faces = finder->find(picture);
    ASSERT_TRUE(faces) << faces.error().message;
    EXPECT_TRUE(faces->empty());
  }
}

TEST_P(AnyFaceFinder, RefusesAPictureThatIsNotBgr) {
  const auto faces = finder->find(cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)));
  ASSERT_FALSE(faces);
  EXPECT_THAT(faces.error().message, HasSubstr("BGR"));
}

TEST_P(AnyFaceFinder, FindsTheRemoteFaceFromHairlineToChin) {
  const std::filesystem::path chat = std::filesystem::path(TELEHUG_FIXTURES) / "chat";
  const auto labels = read_face_labels(chat);
  ASSERT_TRUE(labels) << labels.error().message;
  ASSERT_TRUE(*labels);
  for (const auto& [name, label] : **labels) {
    SCOPED_TRACE(name);
    const auto picture = read_picture(chat / name);
    ASSERT_TRUE(picture) << picture.error().message;
    const auto faces = finder->find(*picture);
    ASSERT_TRUE(faces) << faces.error().message;
    const auto face = largest_face(*faces);
    ASSERT_TRUE(face);
    const cv::Rect2d& truth = label.faces.front().box;
    EXPECT_NEAR(face->box.height, truth.height, GetParam().height * truth.height);
    EXPECT_NEAR(face->box.x + face->box.width / 2, truth.x + truth.width / 2, GetParam().middle * truth.height);
    EXPECT_NEAR(face->box.br().y, truth.br().y, GetParam().chin * truth.height);
    EXPECT_GE(face->score, 0.75);
    EXPECT_LE(face->score, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, AnyFaceFinder,
                         testing::Values(Exactness{"blaze", 0.08, 0.05, 0.06}, Exactness{"haar", 0.15, 0.12, 0.12}));

}  // namespace
}  // namespace telehug
