// SPDX-License-Identifier: Apache-2.0
//
// Decoding some rows of a JPEG picture: the same pixels as of the whole one, whatever the picture, and no harm from
// damaged ones.
#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "doubles/allocation_counter.hpp"
#include "doubles/jpeg_variants.hpp"
#include "doubles/test_pictures.hpp"
#include "pictures/jpeg_decoder.hpp"

namespace telehug {
namespace {

const cv::Scalar untouched = cv::Scalar::all(7);

cv::Mat decoded(const std::vector<std::uint8_t>& jpeg) {
  cv::Mat bgr;
  EXPECT_TRUE(JpegDecoder{}.decode(jpeg, bgr));
  return bgr;
}

bool same_rows(const cv::Mat& a, const cv::Mat& b, int first, int end) {
  return first >= end || cv::norm(a.rowRange(first, end), b.rowRange(first, end), cv::NORM_INF) == 0;
}

void expect_same_rows(JpegDecoder& decoder, const std::vector<std::uint8_t>& jpeg, const cv::Mat& whole,
                      RowRange rows) {
  cv::Mat bgr(whole.size(), CV_8UC3, untouched);
  ASSERT_TRUE(decoder.decode(jpeg, bgr, rows)) << rows.first << " to " << rows.end;
  ASSERT_EQ(bgr.size(), whole.size());
  EXPECT_TRUE(same_rows(bgr, whole, rows.first, std::min(rows.end, whole.rows))) << rows.first << " to " << rows.end;
}

class JpegRows : public ::testing::TestWithParam<JpegVariant> {};

TEST_P(JpegRows, AreThoseOfTheWholePicture) {
  JpegDecoder decoder;
  for (const auto& [width_px, height_px] : {std::pair{80, 96}, {77, 101}, {16, 16}, {33, 7}}) {
    const auto jpeg = jpeg_of(busy_picture(width_px, height_px), GetParam());
    const cv::Mat whole = decoded(jpeg);
    for (int first = 0; first < height_px; ++first) {
      expect_same_rows(decoder, jpeg, whole, {first});
      for (const int count : {1, 2, 8, 17})
        expect_same_rows(decoder, jpeg, whole, {first, std::min(first + count, height_px)});
    }
  }
}

TEST_P(JpegRows, AboveAndBelowThoseThatAreNeededKeepWhatTheyHeld) {
  const auto jpeg = jpeg_of(busy_picture(80, 96), GetParam());
  cv::Mat bgr(96, 80, CV_8UC3, untouched);
  ASSERT_TRUE(JpegDecoder{}.decode(jpeg, bgr, {40, 50}));
  const cv::Mat kept(96, 80, CV_8UC3, untouched);
  EXPECT_TRUE(same_rows(bgr, kept, 0, 32)) << "up to 15 rows above are filled as well";
  EXPECT_TRUE(same_rows(bgr, kept, 50, 96));
}

TEST_P(JpegRows, OfAPictureThatIsCutOffWithinOrBeforeThemAreRefused) {
  const auto jpeg = jpeg_of(busy_picture(80, 96), GetParam());
  const cv::Mat whole = decoded(jpeg);
  JpegDecoder decoder;
  cv::Mat bgr;
  for (std::size_t length = 0; length + 2 < jpeg.size(); length += 100) {
    EXPECT_FALSE(decoder.decode({jpeg.data(), length}, bgr, {48, 96})) << length;
    // Rows that come before the cut may be there; if so they are right.
    if (decoder.decode({jpeg.data(), length}, bgr, {16, 32})) {
      EXPECT_TRUE(same_rows(bgr, whole, 16, 32)) << length;
    }
  }
  expect_same_rows(decoder, jpeg, whole, {48, 96});
}

TEST_P(JpegRows, OfADamagedPictureDoNoHarm) {
  const auto good = jpeg_of(busy_picture(80, 96), GetParam());
  const cv::Mat whole = decoded(good);
  JpegDecoder decoder;
  cv::RNG random(5);
  cv::Mat bgr;
  for (int round = 0; round < 1500; ++round) {
    auto damaged = good;
    for (int i = random.uniform(1, 8); i > 0; --i)
      damaged[static_cast<std::size_t>(random.uniform(2, static_cast<int>(good.size())))] =
          static_cast<std::uint8_t>(random.uniform(0, 256));
    (void)decoder.decode(damaged, bgr, {random.uniform(0, 96), 96});  // some damage only changes colours
  }
  expect_same_rows(decoder, good, whole, {48});
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, JpegRows, ::testing::ValuesIn(jpeg_variants), [](const auto& test) {
  std::string name = test.param.name;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

TEST(JpegRowsOfAStream, ChangeWithItsSizeAndTheRowsThatAreNeeded) {
  JpegDecoder decoder;
  cv::Mat bgr;
  std::uint64_t seed = 1;
  for (const auto& [width_px, height_px, first] :
       {std::tuple{320, 180, 60}, {320, 180, 0}, {1280, 720, 300}, {64, 48, 20}, {1280, 720, 17}, {320, 180, 179}}) {
    const auto jpeg = jpeg_of(busy_picture(width_px, height_px, ++seed));
    ASSERT_TRUE(decoder.decode(jpeg, bgr, {first}));
    const cv::Mat whole = decoded(jpeg);
    ASSERT_EQ(bgr.size(), whole.size());
    EXPECT_TRUE(same_rows(bgr, whole, first, height_px));
  }
}

TEST(JpegRowsOfAStream, AreBlackWhereNewMemoryIsNotFilled) {
  cv::Mat bgr;
  ASSERT_TRUE(JpegDecoder{}.decode(jpeg_of(busy_picture(64, 48)), bgr, {32}));
  EXPECT_EQ(cv::norm(bgr.rowRange(0, 32), cv::NORM_INF), 0);
}

TEST(JpegRowsOfAStream, NeedNoHuffmanTables) {
  const auto jpeg = jpeg_of(sloping_picture(64, 96));
  JpegDecoder decoder;
  expect_same_rows(decoder, without_huffman_tables(jpeg), decoded(jpeg), {40});
}

TEST(JpegRowsOfAStream, BeyondThePictureAreNone) {
  const auto jpeg = jpeg_of(busy_picture(64, 48));
  cv::Mat bgr(48, 64, CV_8UC3, untouched);
  JpegDecoder decoder;
  EXPECT_TRUE(decoder.decode(jpeg, bgr, {48}));
  EXPECT_TRUE(decoder.decode(jpeg, bgr, {500, 600}));
  EXPECT_TRUE(decoder.decode(jpeg, bgr, {-20, -10}));
  EXPECT_TRUE(decoder.decode(jpeg, bgr, {30, 20}));
  EXPECT_TRUE(same_rows(bgr, cv::Mat(48, 64, CV_8UC3, untouched), 0, 48));
  expect_same_rows(decoder, jpeg, decoded(jpeg), {0, 4000});
}

TEST(JpegRowsOfAStream, TakeNothingFromTheHeapOnceAPictureOfThatSizeWasDecoded) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has its own heap";
  const auto jpeg = jpeg_of(busy_picture(640, 360));
  JpegDecoder decoder;
  cv::Mat bgr;
  ASSERT_TRUE(decoder.decode(jpeg, bgr));
  ASSERT_TRUE(decoder.decode(jpeg, bgr, {200}));
  const auto before = allocation_count();
  for (int i = 0; i < 20; ++i)
    (void)decoder.decode(jpeg, bgr, {i % 2 == 0 ? 200 : 0});
  EXPECT_EQ(allocation_count() - before, 0U);
}

}  // namespace
}  // namespace telehug
