// SPDX-License-Identifier: Apache-2.0
#include "face/haar_face_finder.hpp"

#include <gmock/gmock.h>

#include "doubles/largest_face.hpp"
#include "doubles/temporary_folder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

const std::filesystem::path chat = std::filesystem::path(TELEHUG_FIXTURES) / "chat";

std::unique_ptr<FaceFinder> haar() {
  auto finder = make_haar_face_finder();
  EXPECT_TRUE(finder) << finder.error().message;
  return finder ? std::move(*finder) : nullptr;
}

TEST(HaarFaceFinder, FindsTheFaceInTheSamePlaceOfACrop) {
  const auto finder = haar();
  const auto picture = read_picture(chat / "02_self.jpg");
  ASSERT_TRUE(picture) << picture.error().message;
  const cv::Rect view(153, 102, 793, 675);
  const auto faces = finder->find((*picture)(view));
  ASSERT_TRUE(faces);
  const auto face = largest_face(*faces);
  ASSERT_TRUE(face);
  EXPECT_NEAR(face->box.x + face->box.width / 2, 478 + 143 / 2.0 - view.x, 25);
  EXPECT_NEAR(face->box.br().y, 193 + 229 - view.y, 25);
}

TEST(HaarFaceFinder, NamesThePathsTriedAndThePackageWhereTheCascadeIsMissing) {
  const TemporaryFolder folder;
  const auto finder = make_haar_face_finder({folder / "one.xml", folder / "two.xml"});
  ASSERT_FALSE(finder);
  EXPECT_THAT(finder.error().message, HasSubstr((folder / "one.xml").string()));
  EXPECT_THAT(finder.error().message, HasSubstr((folder / "two.xml").string()));
  EXPECT_THAT(finder.error().message, HasSubstr("opencv-data"));
}

TEST(HaarFaceFinder, RefusesAFileThatIsNoCascade) {
  const TemporaryFolder folder;
  for (const auto* content : {"", "not xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n</opencv_storage>\n"}) {
    const auto file = folder.write("cascade.xml", content);
    const auto finder = make_haar_face_finder({file});
    ASSERT_FALSE(finder);
    EXPECT_THAT(finder.error().message, HasSubstr("is not a face cascade"));
  }
}

TEST(HaarFaceFinder, TakesTheFirstPathThatExists) {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> paths{folder / "absent.xml"};
  for (const auto& known : known_haar_cascades()) {
    paths.push_back(known);
  }
  EXPECT_TRUE(make_haar_face_finder(paths));
}

}  // namespace
}  // namespace telehug
