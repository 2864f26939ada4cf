// SPDX-License-Identifier: Apache-2.0
#include "face/make_face_finder.hpp"

#include <gmock/gmock.h>

#include <utility>

#include "doubles/temporary_folder.hpp"

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

class AnyFaceFinder : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<FaceFinder> finder = std::move(make_face_finder(GetParam())->finder);
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

INSTANTIATE_TEST_SUITE_P(Both, AnyFaceFinder, testing::Values("blaze", "haar"));

}  // namespace
}  // namespace telehug
