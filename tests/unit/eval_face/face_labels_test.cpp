// SPDX-License-Identifier: Apache-2.0
#include "eval_face/face_labels.hpp"

#include <gmock/gmock.h>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

constexpr auto labels_header = "image,face_x,face_y,face_w,face_h,role\n";
constexpr auto views_header = "image,view_x,view_y,view_w,view_h,role\n";

TEST(FaceLabels, AreNoneWithoutAFile) {
  const TemporaryFolder folder;
  const auto labels = read_face_labels(folder.path());
  ASSERT_TRUE(labels);
  EXPECT_FALSE(*labels);
}

TEST(FaceLabels, AreReadWithTheViewOfTheRemotePerson) {
  const TemporaryFolder folder;
  folder.write("a.jpg", "");
  folder.write("n.jpg", "");
  folder.write("labels.csv",
               std::string(labels_header) + "a.jpg,1,2,3,4,remote\na.jpg,5,6,7,8,self\nn.jpg,0,0,0,0,none\n");
  folder.write("views.csv", std::string(views_header) + "a.jpg,10,20,30,40,remote\na.jpg,1,1,2,2,self\n");
  const auto read = read_face_labels(folder.path());
  ASSERT_TRUE(read) << read.error().message;
  const FaceLabels& labels = read->value();
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_TRUE(labels.at("n.jpg").faces.empty());
  const LabelledPicture& picture = labels.at("a.jpg");
  ASSERT_EQ(picture.faces.size(), 2U);
  EXPECT_EQ(picture.faces[0].role, FaceRole::remote);
  EXPECT_EQ(picture.faces[0].box, cv::Rect2d(1, 2, 3, 4));
  EXPECT_EQ(picture.faces[1].role, FaceRole::self);
  EXPECT_EQ(picture.remote_view, cv::Rect2d(10, 20, 30, 40));
}

TEST(FaceLabels, TellAllFaultsAtOnceWithFileAndLine) {
  const TemporaryFolder folder;
  folder.write("a.jpg", "");
  folder.write("labels.csv", std::string(labels_header) +
                                 "a.jpg,1,2,3,4,boss\n"
                                 "a.jpg,1,x,3,4,remote\n"
                                 "a.jpg,1,2,3,0,remote\n"
                                 "absent.jpg,1,2,3,4,remote\n");
  folder.write("views.csv", std::string(views_header) + "a.jpg,1,1,remote\n");
  const auto read = read_face_labels(folder.path());
  ASSERT_FALSE(read);
  const std::string& message = read.error().message;
  EXPECT_THAT(message, HasSubstr("labels.csv:2: the role 'boss'"));
  EXPECT_THAT(message, HasSubstr("labels.csv:3: "));
  EXPECT_THAT(message, HasSubstr("labels.csv:4: the face has no size"));
  EXPECT_THAT(message, HasSubstr("absent.jpg: there is no such picture"));
  EXPECT_THAT(message, HasSubstr("views.csv:2: "));
}

}  // namespace
}  // namespace telehug
