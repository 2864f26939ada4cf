// SPDX-License-Identifier: Apache-2.0
#include "eval_face/eval_face.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "doubles/planned_face_finder.hpp"
#include "doubles/temporary_folder.hpp"
#include "face/haar_face_finder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class EvalFaceTest : public testing::Test {
 protected:
  EvalFaceTest() {
    std::filesystem::create_directory(pictures);
    EXPECT_TRUE(write_png(pictures / "b.png", cv::Mat(400, 500, CV_8UC3, cv::Scalar(9, 9, 9))));
    EXPECT_TRUE(write_png(pictures / "a.png", cv::Mat(400, 500, CV_8UC3, cv::Scalar(9, 9, 9))));
  }

  TemporaryFolder folder;
  std::filesystem::path pictures = folder / "pictures";
  std::filesystem::path out = folder / "out.csv";
};

TEST_F(EvalFaceTest, WritesOneRowAPictureInOrderOfTheNames) {
  PlannedFaceFinder finder({{.box = {220, 60, 60.25, 80}, .score = 1}});
  const auto evaluation = eval_face(pictures, out, finder);
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  EXPECT_EQ(text_of(out),
            "image,face_x,face_y,face_w,face_h\na.png,220.0,60.0,60.2,80.0\nb.png,220.0,60.0,60.2,80.0\n");
  EXPECT_EQ(evaluation->pictures, 2);
  EXPECT_EQ(evaluation->picked, 2);
  EXPECT_FALSE(evaluation->scores) << "there are no labels";
}

TEST_F(EvalFaceTest, LeavesTheFieldsEmptyWhereThereIsNoFace) {
  PlannedFaceFinder finder;
  ASSERT_TRUE(eval_face(pictures, out, finder));
  EXPECT_EQ(text_of(out), "image,face_x,face_y,face_w,face_h\na.png,,,,\nb.png,,,,\n");
}

TEST_F(EvalFaceTest, ComparesWithLabels) {
  std::ofstream(pictures / "labels.csv") << "image,face_x,face_y,face_w,face_h,role\n"
                                            "a.png,220,60,60,80,remote\nb.png,0,0,0,0,none\n";
  PlannedFaceFinder finder({{.box = {220, 60, 60, 80}, .score = 1}});
  const auto evaluation = eval_face(pictures, out, finder);
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  ASSERT_TRUE(evaluation->scores);
  EXPECT_EQ(evaluation->scores->remote_picked, 1);
  EXPECT_EQ(evaluation->scores->false_picks, 1);
}

TEST_F(EvalFaceTest, WritesNothingIfAPictureCanNotBeRead) {
  std::ofstream(pictures / "c.jpg") << "no picture";
  PlannedFaceFinder finder;
  const auto evaluation = eval_face(pictures, out, finder);
  ASSERT_FALSE(evaluation);
  EXPECT_THAT(evaluation.error().message, HasSubstr("c.jpg"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(EvalFaceTest, SaysWhatIsMissing) {
  PlannedFaceFinder finder;
  EXPECT_FALSE(eval_face(folder / "absent", out, finder));
  const auto unwritable = eval_face(pictures, folder / "absent" / "out.csv", finder);
  ASSERT_FALSE(unwritable);
  EXPECT_THAT(unwritable.error().message, HasSubstr("out.csv can't be written"));
}

TEST_F(EvalFaceTest, PicksTheRemoteFaceOfEveryChatPictureWithHaar) {
  auto finder = make_haar_face_finder();
  ASSERT_TRUE(finder) << finder.error().message;
  const auto evaluation = eval_face(std::filesystem::path(TELEHUG_FIXTURES) / "chat", out, **finder);
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  ASSERT_TRUE(evaluation->scores);
  EXPECT_GE(evaluation->scores->pictures_with_remote, 2);
  EXPECT_EQ(evaluation->scores->remote_picked, evaluation->scores->pictures_with_remote);
}

}  // namespace
}  // namespace telehug
