// SPDX-License-Identifier: Apache-2.0
#include "pictures/jpeg_decoder.hpp"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "doubles/test_pictures.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

double largest_difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF);
}

TEST(JpegDecoder, GivesBlueGreenRed) {
  JpegDecoder decoder;
  cv::Mat bgr;
  ASSERT_TRUE(decoder.decode(jpeg_of(plain_picture(64, 48, {200, 100, 50})), bgr));
  ASSERT_EQ(bgr.type(), CV_8UC3);
  ASSERT_EQ(bgr.size(), cv::Size(64, 48));
  EXPECT_LE(largest_difference(bgr, plain_picture(64, 48, {200, 100, 50})), 3);
}

TEST(JpegDecoder, KeepsTheMemoryOfThePicture) {
  JpegDecoder decoder;
  cv::Mat bgr;
  ASSERT_TRUE(decoder.decode(jpeg_of(plain_picture(64, 48, {1, 2, 3})), bgr));
  const auto* data = bgr.data;
  ASSERT_TRUE(decoder.decode(jpeg_of(plain_picture(64, 48, {100, 2, 3})), bgr));
  EXPECT_EQ(bgr.data, data);
}

TEST(JpegDecoder, GivesEveryPictureRightWhateverCameBefore) {
  JpegDecoder decoder;
  for (const auto& [width_px, height_px] :
       {std::pair{64, 48}, {400, 300}, {17, 9}, {400, 300}, {1280, 720}, {64, 48}}) {
    const cv::Mat picture = sloping_picture(width_px, height_px);
    cv::Mat used;
    cv::Mat fresh;
    ASSERT_TRUE(decoder.decode(jpeg_of(picture), used));
    ASSERT_TRUE(JpegDecoder{}.decode(jpeg_of(picture), fresh));
    EXPECT_EQ(largest_difference(used, fresh), 0);
  }
}

TEST(JpegDecoder, DecodesPicturesWithoutHuffmanTables) {
  const cv::Mat picture = sloping_picture(64, 48);
  const auto complete = jpeg_of(picture);
  const auto webcam = without_huffman_tables(complete);
  ASSERT_LT(webcam.size(), complete.size());
  cv::Mat bgr;
  JpegDecoder decoder;
  ASSERT_TRUE(decoder.decode(webcam, bgr));
  EXPECT_LE(largest_difference(bgr, picture), 12);
}

TEST(JpegDecoder, RefusesAPictureThatIsCutOffAnywhere) {
  const auto jpeg = jpeg_of(sloping_picture(64, 48));
  JpegDecoder decoder;
  cv::Mat bgr;
  for (std::size_t length = 0; length + 2 < jpeg.size(); length += 7) {
    EXPECT_FALSE(decoder.decode({jpeg.data(), length}, bgr)) << length;
  }
}

TEST(JpegDecoder, SurvivesAnySingleDamagedByteAndStillDecodesTheNextPicture) {
  const auto good = jpeg_of(sloping_picture(48, 32));
  JpegDecoder decoder;
  cv::Mat bgr;
  for (std::size_t at = 0; at < good.size(); ++at) {
    auto damaged = good;
    damaged[at] ^= 0xFF;
    (void)decoder.decode(damaged, bgr);  // some damage only changes colours; none may end the program
  }
  ASSERT_TRUE(decoder.decode(good, bgr));
  EXPECT_LE(largest_difference(bgr, sloping_picture(48, 32)), 12);
}

TEST(JpegDecoder, SaysThatGarbageIsDamaged) {
  const std::vector<std::uint8_t> garbage(1000, 0x55);
  cv::Mat bgr;
  const Status decoded = JpegDecoder{}.decode(garbage, bgr);
  ASSERT_FALSE(decoded);
  EXPECT_THAT(decoded.error().message, HasSubstr("damaged JPEG picture"));
}

TEST(JpegDecoder, RefusesPicturesThatClaimToBeEnormous) {
  auto jpeg = jpeg_of(plain_picture(64, 48, {0, 0, 0}));
  for (std::size_t at = 0; at + 8 < jpeg.size(); ++at) {
    if (jpeg[at] == 0xFF && jpeg[at + 1] == 0xC0) jpeg[at + 5] = jpeg[at + 7] = 0xF0;  // start of frame: height, width
  }
  cv::Mat bgr;
  const Status decoded = JpegDecoder{}.decode(jpeg, bgr);
  ASSERT_FALSE(decoded);
  EXPECT_THAT(decoded.error().message, HasSubstr("8192"));
}

}  // namespace
}  // namespace telehug
