// SPDX-License-Identifier: Apache-2.0
#include "finger/overview.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "doubles/allocation_counter.hpp"
#include "finger/background_strip.hpp"

namespace telehug {
namespace {

constexpr ImageSize image{1280, 720};
constexpr double px_per_mm = 3;  // 5 px a cell

constexpr std::size_t channels = 5;
constexpr int rows_beyond = 8;

class OverviewTest : public testing::Test {
 protected:
  void sample(const cv::Mat& bgr) {
    tiles_ = overview_.tiles(distance_);
    values_.resize(static_cast<std::size_t>(overview_.rows() * overview_.columns()) * channels);
    overview_.sample(bgr, 0, overview_.columns(), values_.data());
  }
  [[nodiscard]] float at(int column, int row, int channel) const {
    return values_[static_cast<std::size_t>(row * overview_.columns() + column) * channels +
                   static_cast<std::size_t>(channel)];
  }
  // All rails of some of the strip's columns differ from the background.
  void differ(int first, int end) {
    for (int rail = 0; rail < BorderStrip::rails; ++rail) {
      for (int i = first; i < end; ++i)
        distance_[static_cast<std::size_t>(rail * layout_.columns + i)] = BackgroundStrip::far;
    }
  }

  BorderCurve border_{BorderLine{500, 0.02}, image};
  BorderStrip::Layout layout_{border_, image};
  std::vector<float> distance_ = std::vector<float>(layout_.cells(), 0.0F);
  Overview overview_{border_, layout_, px_per_mm};
  Overview::Tiles tiles_;
  std::vector<float> values_;
};

TEST_F(OverviewTest, ReachesFromTheDeskToThePicturesEnd) {
  EXPECT_EQ(overview_.cell_px(), 5);
  EXPECT_EQ(overview_.columns(), 256);
  EXPECT_NEAR(overview_.picture_point(0, 0).v_px, 500 - 120 + 2, 1);
  EXPECT_NEAR(overview_.picture_point(0, overview_.rows() - rows_beyond - 1).v_px, 717, 5);
}

TEST_F(OverviewTest, CellsAreMeansOfTheirPixels) {
  cv::Mat bgr(image.height_px, image.width_px, CV_8UC3);
  cv::RNG random(1);
  random.fill(bgr, cv::RNG::UNIFORM, 0, 256);
  sample(bgr);
  for (const auto& [column, row] : {std::pair{0, 0}, {255, 10}, {77, overview_.rows() - rows_beyond - 1}}) {
    const int left = column * 5;
    const int top = static_cast<int>(std::lround(overview_.picture_point(column, row).v_px)) - 2;
    const cv::Scalar mean = cv::mean(bgr(cv::Rect(left, top, 5, 5)));
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(at(column, row, k), mean[k] / 127.5 - 1, 1e-4) << column << " " << row;
  }
}

TEST_F(OverviewTest, TellsWhatDiffersFromTheBackgroundWhereTheStripIs) {
  differ(300, 320);
  sample(cv::Mat::zeros(image.height_px, image.width_px, CV_8UC3));
  for (int row = 0; row < overview_.rows(); ++row) {
    for (int column = 0; column < overview_.columns(); ++column) {
      const ImagePoint middle = overview_.picture_point(column, row);
      const double before_px = border_.v_at(middle.u_px) - middle.v_px;
      const bool in_strip = before_px > 3 && before_px < 65;
      const bool differs = middle.u_px > 606 && middle.u_px < 634;
      const bool beside = middle.u_px < 594 || middle.u_px > 646;
      if (in_strip && differs) {
        EXPECT_FLOAT_EQ(at(column, row, 3), 1) << column << " " << row;
      } else if (beside || before_px < 0 || before_px > 70) {
        EXPECT_EQ(at(column, row, 3), 0) << column << " " << row;
      }
    }
  }
}

// The edge is not level, so each rail passes through the middle of some cells.
TEST_F(OverviewTest, TellsOfEveryRailOfTheStrip) {
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    std::fill(distance_.begin(), distance_.end(), 0.0F);
    std::fill_n(distance_.begin() + static_cast<std::ptrdiff_t>(rail) * layout_.columns, layout_.columns,
                BackgroundStrip::far);
    sample(cv::Mat::zeros(image.height_px, image.width_px, CV_8UC3));
    int cells = 0;
    for (int row = 0; row < overview_.rows(); ++row) {
      for (int column = 0; column < overview_.columns(); ++column)
        cells += at(column, row, 3) == 1 ? 1 : 0;
    }
    EXPECT_GT(cells, 0) << rail;
  }
}

TEST_F(OverviewTest, HasNoTileWhereNothingDiffers) {
  EXPECT_TRUE(overview_.tiles(distance_).empty());
  distance_[static_cast<std::size_t>(3 * layout_.columns + 200)] = BackgroundStrip::far;  // a speck
  EXPECT_TRUE(overview_.tiles(distance_).empty());
}

TEST_F(OverviewTest, LaysTilesAboutAllThatDiffers) {
  for (const auto& [first, end] : {std::pair{0, 12}, {300, 330}, {628, 640}, {100, 540}, {0, 640}}) {
    std::fill(distance_.begin(), distance_.end(), 0.0F);
    differ(first, end);
    const auto& tiles = overview_.tiles(distance_);
    for (int i = first; i < end; ++i) {
      const double column = overview_.cell_of({layout_.column_centre_px(i), 0}).u_px;
      bool inside = false;
      for (const Overview::Tile& tile : tiles) {
        const double reach = 28;  // a finger may lean so far, unless the picture ends
        inside = inside || (column - std::min(reach, column) >= tile.first_column - 1 &&
                            std::min<double>(column + reach, overview_.columns()) <=
                                tile.first_column + overview_.tile_columns()[tile.width] + 1);
      }
      EXPECT_TRUE(inside) << i << " of " << first << " to " << end;
    }
  }
  EXPECT_EQ(overview_.tiles(std::vector<float>(layout_.cells(), 0.0F)).size(), 0U);
}

TEST_F(OverviewTest, LaysNarrowTilesAboutOneFingerAndWideOnesAboutMore) {
  differ(300, 330);  // 12 cells, 21 mm
  ASSERT_EQ(overview_.tiles(distance_).size(), 1U);
  EXPECT_EQ(overview_.tiles(distance_)[0].width, 0U);
  differ(370, 400);  // 40 cells from the first to the last
  ASSERT_EQ(overview_.tiles(distance_).size(), 1U);
  EXPECT_EQ(overview_.tiles(distance_)[0].width, 1U);
  differ(430, 450);  // 60 cells
  ASSERT_EQ(overview_.tiles(distance_).size(), 1U);
  EXPECT_EQ(overview_.tiles(distance_)[0].width, 2U);
}

TEST_F(OverviewTest, ATileIsPartOfTheWhole) {
  cv::Mat bgr(image.height_px, image.width_px, CV_8UC3);
  cv::RNG random(2);
  random.fill(bgr, cv::RNG::UNIFORM, 0, 256);
  differ(300, 320);
  sample(bgr);
  const auto [first_column, width] = tiles_.front();
  const int columns = overview_.tile_columns()[width];
  std::vector<float> tile(static_cast<std::size_t>(overview_.rows() * columns) * channels);
  overview_.sample(bgr, first_column, columns, tile.data());
  for (int row = 0; row < overview_.rows(); row += 7) {
    for (int column = 0; column < columns; column += 5) {
      for (int k = 0; k < 5; ++k) {
        const auto i = static_cast<std::size_t>(row * columns + column) * channels;
        EXPECT_EQ(tile[i + static_cast<std::size_t>(k)], at(first_column + column, row, k));
      }
    }
  }
}

TEST_F(OverviewTest, TellsHowFarTheEdgeOfTheScreenIs) {
  sample(cv::Mat::zeros(image.height_px, image.width_px, CV_8UC3));
  for (const int column : {0, 100, 255}) {
    const double edge =
        overview_
            .cell_of({overview_.picture_point(column, 0).u_px, border_.v_at(overview_.picture_point(column, 0).u_px)})
            .v_px;
    for (int row = 0; row < overview_.rows(); ++row)
      EXPECT_NEAR(at(column, row, 4), std::clamp((row - edge) / 16, -1.0, 1.0), 0.02) << column << " " << row;
    for (int row = overview_.rows() - rows_beyond; row < overview_.rows(); ++row)
      EXPECT_EQ(at(column, row, 4), at(column, row - 1, 4)) << "it goes on as it ends";
  }
}

TEST_F(OverviewTest, PlacesGoForthAndBack) {
  const ImagePoint point{321.25, 555.5};
  const ImagePoint cell = overview_.cell_of(point);
  EXPECT_NEAR(overview_.picture_point(cell.u_px, cell.v_px).u_px, point.u_px, 1e-9);
  EXPECT_NEAR(overview_.picture_point(cell.u_px, cell.v_px).v_px, point.v_px, 1e-9);
}

TEST_F(OverviewTest, AllocatesNothingPerFrame) {
  const cv::Mat bgr(image.height_px, image.width_px, CV_8UC3, cv::Scalar::all(90));
  differ(100, 130);
  sample(bgr);
  const auto before = allocation_count();
  (void)overview_.tiles(distance_);
  overview_.sample(bgr, 10, overview_.tile_columns().back(), values_.data());
  EXPECT_EQ(allocation_count(), before);
}

TEST(OverviewOf, SmallPicturesAndEdgesNearTheirEndIsPossible) {
  for (const ImageSize size : {ImageSize{320, 180}, ImageSize{640, 360}, ImageSize{1920, 1080}}) {
    for (const double share : {0.02, 0.5, 0.97}) {
      for (const double scale : {0.6, 2.0, 9.0}) {
        const BorderCurve border(BorderLine{share * size.height_px, 0.05}, size);
        const BorderStrip::Layout layout(border, size);
        try {
          Overview overview(border, layout, scale);
          std::vector<float> values(static_cast<std::size_t>(overview.rows() * overview.tile_columns().back()) *
                                    channels);
          const std::vector<float> distance(layout.cells(), 4.0F);
          for (const auto& [first, width] : overview.tiles(distance)) {
            const int columns = overview.tile_columns()[width];
            EXPECT_GE(first, 0);
            EXPECT_LE(first + columns, overview.columns());
            overview.sample(cv::Mat::zeros(size.height_px, size.width_px, CV_8UC3), first, columns, values.data());
          }
          EXPECT_LE(overview.picture_point(0, overview.rows() - rows_beyond - 1).v_px, size.height_px);
        } catch (const std::invalid_argument&) {
          const double cell_px = std::max(1.0, std::round(scale * Overview::cell_mm));
          const double rows_px = (1 - share) * size.height_px + std::min(24 * cell_px, share * size.height_px);
          EXPECT_LT(std::min<double>(size.width_px, rows_px), 17 * cell_px) << "only few cells are no overview";
        }
      }
    }
  }
}

}  // namespace
}  // namespace telehug
