// SPDX-License-Identifier: Apache-2.0
#include "face/blaze_face_finder.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "doubles/largest_face.hpp"
#include "doubles/temporary_folder.hpp"
#include "eval_face/eval_face.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

const std::filesystem::path chat = std::filesystem::path(TELEHUG_FIXTURES) / "chat";

std::unique_ptr<FaceFinder> blaze() {
  auto finder = make_blaze_face_finder();
  EXPECT_TRUE(finder) << finder.error().message;
  return finder ? std::move(*finder) : nullptr;
}

std::string bytes_of_the_model() {
  for (const auto& path : known_blaze_models()) {
    std::ostringstream bytes;
    if (bytes << std::ifstream(path, std::ios::binary).rdbuf()) return bytes.str();
  }
  return {};
}

TEST(BlazeFaceFinder, FindsTheSameInAPictureWithAFourthChannel) {
  const auto finder = blaze();
  const auto picture = read_picture(chat / "02_self.jpg");
  ASSERT_TRUE(picture);
  cv::Mat bgrx;
  cv::cvtColor(*picture, bgrx, cv::COLOR_BGR2BGRA);
  const auto faces = finder->find(*picture);
  const auto same = finder->find(bgrx);
  ASSERT_TRUE(faces && same);
  ASSERT_EQ(faces->size(), same->size());
  for (std::size_t i = 0; i < faces->size(); ++i) {
    EXPECT_EQ((*faces)[i].box, (*same)[i].box);
    EXPECT_EQ((*faces)[i].score, (*same)[i].score);
  }
}

// A picture is halved before it is interpolated, so that one that was halved twice gives the same.
TEST(BlazeFaceFinder, AveragesALargePictureInsteadOfSkippingPixels) {
  const auto finder = blaze();
  const auto picture = read_picture(chat / "02_self.jpg");
  ASSERT_TRUE(picture);
  cv::Mat large;
  cv::resize(*picture, large, {1920, 1536}, 0, 0, cv::INTER_LINEAR);
  cv::Mat half;
  cv::Mat quarter;
  cv::resize(large, half, {960, 768}, 0, 0, cv::INTER_AREA);
  cv::resize(half, quarter, {480, 384}, 0, 0, cv::INTER_AREA);
  const auto in_large = finder->find(large);
  const auto in_quarter = finder->find(quarter);
  ASSERT_TRUE(in_large && in_quarter);
  ASSERT_FALSE(in_large->empty());
  ASSERT_EQ(in_large->size(), in_quarter->size());
  for (std::size_t i = 0; i < in_large->size(); ++i) {
    EXPECT_NEAR((*in_large)[i].score, (*in_quarter)[i].score, 1e-6);
    EXPECT_NEAR((*in_large)[i].box.height, 4 * (*in_quarter)[i].box.height, 1e-3);
  }
}

// In wide and in high pictures, from 160 px on; below 130 px heights are off by a tenth.
TEST(BlazeFaceFinder, FindsAFaceOfManySizesAtItsPlace) {
  const auto finder = blaze();
  const auto picture = read_picture(chat / "02_self.jpg");
  ASSERT_TRUE(picture);
  const cv::Rect person(300, 120, 500, 600);
  const cv::Rect2d truth(478 - 300, 193 - 120, 143, 229);
  for (const double scale : {0.7, 1.0, 1.5}) {
    for (const cv::Size size : {cv::Size(1920, 1080), cv::Size(1080, 1920), cv::Size(1280, 1024)}) {
      SCOPED_TRACE(testing::Message() << scale << " in " << size.width << "x" << size.height);
      cv::Mat screen(size, CV_8UC3, cv::Scalar(60, 60, 60));
      cv::Mat scaled;
      cv::resize((*picture)(person), scaled, {}, scale, scale, cv::INTER_AREA);
      const cv::Point at((size.width - scaled.cols) / 3, (size.height - scaled.rows) / 2);
      scaled.copyTo(screen(cv::Rect(at, scaled.size())));
      const auto faces = finder->find(screen);
      ASSERT_TRUE(faces);
      const auto face = largest_face(*faces);
      ASSERT_TRUE(face);
      EXPECT_NEAR(face->box.height, truth.height * scale, 0.15 * truth.height * scale);
      EXPECT_NEAR(face->box.x + face->box.width / 2, at.x + (truth.x + truth.width / 2) * scale,
                  0.10 * truth.height * scale);
      EXPECT_NEAR(face->box.br().y, at.y + truth.br().y * scale, 0.12 * truth.height * scale);
    }
  }
}

TEST(BlazeFaceFinder, NamesThePathsTriedWhereTheModelIsMissing) {
  const TemporaryFolder folder;
  const auto finder = make_blaze_face_finder({folder / "one.onnx", folder / "two.onnx"});
  ASSERT_FALSE(finder);
  EXPECT_THAT(finder.error().message, HasSubstr((folder / "one.onnx").string()));
  EXPECT_THAT(finder.error().message, HasSubstr((folder / "two.onnx").string()));
  EXPECT_THAT(finder.error().message, HasSubstr("install telehug again"));
}

TEST(BlazeFaceFinder, RefusesAFileThatDiffersFromTheModelInOneByte) {
  const TemporaryFolder folder;
  const std::string model = bytes_of_the_model();
  ASSERT_EQ(model.size(), 603'432U);
  EXPECT_TRUE(make_blaze_face_finder({folder.write("right.onnx", model)}));
  std::string other = model;
  other[300'000] = static_cast<char>(other[300'000] ^ 1);
  for (const std::string& wrong : {other, model.substr(1), std::string(), std::string("not a model")}) {
    const auto file = folder.write("wrong.onnx", wrong);
    const auto finder = make_blaze_face_finder({file});
    ASSERT_FALSE(finder);
    EXPECT_THAT(finder.error().message, HasSubstr(file.string()));
  }
}

// All labelled pictures, where they stand beside the project: 22 with a remote person, 5 with nobody.
TEST(FaceSamples, AreAllPickedAndNothingElse) {
  const std::filesystem::path samples = std::filesystem::path(TELEHUG_SOURCE) / ".." / "shared" / "face-samples";
  if (!std::filesystem::exists(samples / "labels.csv")) GTEST_SKIP() << "the full set of pictures is not here";
  const TemporaryFolder folder;
  const auto evaluation = eval_face(samples, folder / "out.csv", *blaze());
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  ASSERT_TRUE(evaluation->scores);
  const FaceScores& scores = *evaluation->scores;
  EXPECT_EQ(scores.remote_found, 22);
  EXPECT_EQ(scores.remote_picked, 22);
  EXPECT_EQ(scores.pictures_without_face, 5);
  EXPECT_EQ(scores.false_picks, 0);
  const auto share_within = [&](double limit) {
    return static_cast<double>(std::ranges::count_if(scores.height_errors, [&](double e) { return e <= limit; })) / 22;
  };
  EXPECT_GE(share_within(0.08), 0.5);
  EXPECT_GE(share_within(0.15), 0.9);
}

}  // namespace
}  // namespace telehug
