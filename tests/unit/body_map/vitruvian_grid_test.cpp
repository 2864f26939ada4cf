// SPDX-License-Identifier: Apache-2.0
#include "body_map/vitruvian_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace telehug {
namespace {

// A face 40 mm high with its chin at y = 100 and its middle at x = 200: boxes of 20 mm.
const ScreenRect face{.x_mm = 185, .y_mm = 60, .width_mm = 30, .height_mm = 40};

// A picture of the person that ends there and cuts nothing off at the sides.
ScreenRect view_to(double bottom_mm) {
  return {.x_mm = -10'000, .y_mm = 0, .width_mm = 20'000, .height_mm = bottom_mm};
}

BodyMap map_of(const ScreenRect& rect, double bottom_mm) {
  const auto map = make_body_map(rect, view_to(bottom_mm));
  EXPECT_TRUE(map);
  return map.value_or(BodyMap{});
}

bool covers(const ScreenRect& rect, const ScreenPoint& point) {
  return point.x_mm >= rect.x_mm && point.x_mm < rect.x_mm + rect.width_mm && point.y_mm >= rect.y_mm &&
         point.y_mm < rect.y_mm + rect.height_mm;
}

// Faces and bottoms of all sizes, also such whose grid reaches past the screen.
struct RandomMaps {
  std::mt19937 random{20240611};
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
  BodyMap next() {
    const ScreenRect rect{
        .x_mm = number(-20, 500), .y_mm = number(-10, 200), .width_mm = number(5, 100), .height_mm = number(10, 150)};
    return map_of(rect, rect.y_mm + rect.height_mm + number(0.5, 300));
  }
};

TEST(VitruvianGrid, HangsFromTheChinCentredOnTheFace) {
  const BodyMap map = map_of(face, 200);
  EXPECT_DOUBLE_EQ(map.box_side_mm, 20);
  EXPECT_DOUBLE_EQ(map.grid.width_mm, 100);
  EXPECT_DOUBLE_EQ(map.grid.x_mm, 150);
  EXPECT_DOUBLE_EQ(map.grid.y_mm, 100);
  EXPECT_DOUBLE_EQ(map.grid.height_mm, 100);
  EXPECT_EQ(map.shape, (GridShape{.columns = 5, .rows = 5}));
  EXPECT_EQ(map.version, 0U);
}

TEST(VitruvianGrid, CutsTheLastRowAtTheBottom) {
  const BodyMap map = map_of(face, 145);
  EXPECT_EQ(map.shape.rows, 3);
  const auto last = box_rect(map, 15);
  ASSERT_TRUE(last);
  EXPECT_DOUBLE_EQ(last->y_mm, 140);
  EXPECT_DOUBLE_EQ(last->height_mm, 5);
  EXPECT_DOUBLE_EQ(last->width_mm, 20);
}

TEST(VitruvianGrid, HasOneRowWhereLessThanOneFits) {
  EXPECT_EQ(map_of(face, 100.001).shape.rows, 1);
}

TEST(VitruvianGrid, AddsNoRowForRounding) {
  RandomMaps maps;
  for (int i = 0; i < 10000; ++i) {
    const double height_mm = maps.number(10, 150);
    const double top_mm = maps.number(-10, 200);
    const int rows = 1 + i % 12;
    const BodyMap map = map_of({.x_mm = 0, .y_mm = top_mm, .width_mm = 10, .height_mm = height_mm},
                               top_mm + height_mm + rows * height_mm / 2);
    ASSERT_EQ(map.shape.rows, rows);
  }
}

TEST(VitruvianGrid, IsNotMadeWhereThereIsNoBody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(make_body_map(face, view_to(100))) << "the chin is the bottom";
  EXPECT_FALSE(make_body_map(face, view_to(80)));
  EXPECT_FALSE(make_body_map(face, view_to(nan)));
  EXPECT_FALSE(make_body_map(face, view_to(std::numeric_limits<double>::infinity())));
  EXPECT_FALSE(make_body_map(face, {.x_mm = 251, .y_mm = 0, .width_mm = 100, .height_mm = 200})) << "beside the grid";
  EXPECT_FALSE(make_body_map(face, {.x_mm = 0, .y_mm = 0, .width_mm = nan, .height_mm = 200}));
  EXPECT_FALSE(make_body_map({}, view_to(100))) << "the face has no height";
  EXPECT_FALSE(make_body_map({.x_mm = nan, .y_mm = 0, .width_mm = 10, .height_mm = 10}, view_to(100)));
  EXPECT_FALSE(make_body_map({.x_mm = 0, .y_mm = 0, .width_mm = 10, .height_mm = -10}, view_to(100)));
  EXPECT_FALSE(make_body_map({.x_mm = 0, .y_mm = 0, .width_mm = 1e-9, .height_mm = 1e-9}, view_to(100)))
      << "too many rows";
}

TEST(VitruvianGrid, NumbersBoxesRowByRowFromTheLeft) {
  const BodyMap map = map_of(face, 200);
  EXPECT_EQ(box_at(map, {.x_mm = 151, .y_mm = 101})->box, 1);
  EXPECT_EQ(box_at(map, {.x_mm = 249, .y_mm = 101})->box, 5);
  EXPECT_EQ(box_at(map, {.x_mm = 151, .y_mm = 121})->box, 6);
  EXPECT_EQ(box_at(map, {.x_mm = 200, .y_mm = 150})->box, 13);
  EXPECT_EQ(box_at(map, {.x_mm = 249, .y_mm = 199})->box, 25);
}

TEST(VitruvianGrid, TellsThePlaceOnTheBodyInFaceHeightsFromTheChin) {
  const auto hit = box_at(map_of(face, 200), {.x_mm = 220, .y_mm = 160});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->body.x_fh, 0.5);
  EXPECT_DOUBLE_EQ(hit->body.y_fh, 1.5);
}

TEST(VitruvianGrid, PutsEveryPointInsideIntoExactlyTheBoxThatCoversIt) {
  RandomMaps maps;
  for (int i = 0; i < 10000; ++i) {
    const BodyMap map = maps.next();
    const ScreenPoint point{.x_mm = map.grid.x_mm + maps.number(0.001, 0.999) * map.grid.width_mm,
                            .y_mm = map.grid.y_mm + maps.number(0.001, 0.999) * map.grid.height_mm};
    int covering = 0;
    int box = 0;
    for (std::uint16_t number = 1; number <= map.shape.columns * map.shape.rows; ++number) {
      if (covers(*box_rect(map, number), point)) {
        ++covering;
        box = number;
      }
    }
    ASSERT_EQ(covering, 1);
    const auto hit = box_at(map, point);
    ASSERT_TRUE(hit);
    ASSERT_EQ(hit->box, box);
  }
}

TEST(VitruvianGrid, FindsEveryBoxAtItsCentre) {
  RandomMaps maps;
  for (int i = 0; i < 1000; ++i) {
    const BodyMap map = maps.next();
    for (std::uint16_t number = 1; number <= map.shape.columns * map.shape.rows; ++number) {
      const ScreenRect rect = *box_rect(map, number);
      const auto hit = box_at(map, {.x_mm = rect.x_mm + rect.width_mm / 2, .y_mm = rect.y_mm + rect.height_mm / 2});
      ASSERT_TRUE(hit);
      ASSERT_EQ(hit->box, number);
    }
  }
}

TEST(VitruvianGrid, FindsNoBoxOutside) {
  RandomMaps maps;
  for (int i = 0; i < 1000; ++i) {
    const BodyMap map = maps.next();
    const double inside_x = map.grid.x_mm + map.grid.width_mm * maps.number(0, 1);
    const double inside_y = map.grid.y_mm + map.grid.height_mm * maps.number(0, 1);
    const double off = maps.number(0.001, 500);
    ASSERT_FALSE(box_at(map, {.x_mm = map.grid.x_mm - off, .y_mm = inside_y}));
    ASSERT_FALSE(box_at(map, {.x_mm = map.grid.x_mm + map.grid.width_mm + off, .y_mm = inside_y}));
    ASSERT_FALSE(box_at(map, {.x_mm = inside_x, .y_mm = map.grid.y_mm - off}));
    ASSERT_FALSE(box_at(map, {.x_mm = inside_x, .y_mm = map.grid.y_mm + map.grid.height_mm + off}));
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(box_at(map_of(face, 200), {.x_mm = nan, .y_mm = 150}));
  EXPECT_FALSE(box_at(map_of(face, 200), {.x_mm = 200, .y_mm = nan}));
}

TEST(VitruvianGrid, GivesEveryEdgeToExactlyOneBox) {
  const BodyMap map = map_of(face, 200);
  EXPECT_EQ(box_at(map, {.x_mm = 150, .y_mm = 100})->box, 1) << "the grid's top left corner";
  EXPECT_EQ(box_at(map, {.x_mm = 170, .y_mm = 110})->box, 2) << "an upright edge: the box right of it";
  EXPECT_EQ(box_at(map, {.x_mm = 160, .y_mm = 120})->box, 6) << "a level edge: the box below";
  EXPECT_EQ(box_at(map, {.x_mm = 170, .y_mm = 120})->box, 7) << "an inner corner";
  EXPECT_EQ(box_at(map, {.x_mm = 250, .y_mm = 110})->box, 5) << "the grid's right edge";
  EXPECT_EQ(box_at(map, {.x_mm = 160, .y_mm = 200})->box, 21) << "the grid's bottom";
  EXPECT_EQ(box_at(map, {.x_mm = 250, .y_mm = 200})->box, 25) << "its far corner";
}

TEST(VitruvianGrid, KeepsTheNumbersOfBoxesThatThePicturesEdgeCuts) {
  // The middle of the face at x = 5: the first two columns lie left of the picture, the third across its edge.
  const auto map = make_body_map({.x_mm = 0, .y_mm = 60, .width_mm = 10, .height_mm = 40},
                                 {.x_mm = 0, .y_mm = 0, .width_mm = 30, .height_mm = 200});
  ASSERT_TRUE(map);
  EXPECT_FALSE(box_rect(*map, 1));
  EXPECT_FALSE(box_rect(*map, 2));
  EXPECT_DOUBLE_EQ(box_rect(*map, 3)->x_mm, 0);
  EXPECT_DOUBLE_EQ(box_rect(*map, 3)->width_mm, 15);
  EXPECT_DOUBLE_EQ(box_rect(*map, 4)->width_mm, 15) << "cut at the right";
  EXPECT_EQ(box_at(*map, {.x_mm = 0, .y_mm = 101})->box, 3);
  EXPECT_EQ(box_at(*map, {.x_mm = 21, .y_mm = 101})->box, 4);
}

TEST(VitruvianGrid, HasNoBodyBesideThePicture) {
  const auto map = make_body_map(face, {.x_mm = 170, .y_mm = 0, .width_mm = 60, .height_mm = 200});
  ASSERT_TRUE(map);
  EXPECT_FALSE(box_at(*map, {.x_mm = 169, .y_mm = 150})) << "another window lies there";
  EXPECT_TRUE(box_at(*map, {.x_mm = 171, .y_mm = 150}));
  EXPECT_TRUE(box_at(*map, {.x_mm = 229, .y_mm = 150}));
  EXPECT_FALSE(box_at(*map, {.x_mm = 231, .y_mm = 150}));
}

// As in a mirror the person's left is on the left: the same part of the body keeps its number and its place.
TEST(VitruvianGrid, CountsFromTheRightInAMirroredPicture) {
  const BodyMap plain = map_of(face, 200);
  const BodyMap mirrored = make_body_map(face, view_to(200), true).value();
  for (double x = 151; x < 250; x += 7) {
    const auto hit = box_at(plain, {.x_mm = x, .y_mm = 130});
    const auto other = box_at(mirrored, {.x_mm = 400 - x, .y_mm = 130});
    ASSERT_TRUE(hit && other);
    EXPECT_EQ(hit->box, other->box);
    EXPECT_DOUBLE_EQ(hit->body.x_fh, other->body.x_fh);
    EXPECT_DOUBLE_EQ(hit->body.y_fh, other->body.y_fh);
    EXPECT_LE(box_rect(mirrored, other->box)->x_mm, 400 - x);
    EXPECT_GE(box_rect(mirrored, other->box)->x_mm + 20, 400 - x);
  }
}

TEST(VitruvianGrid, HasNoBoxesWithoutAMap) {
  const BodyMap none;
  EXPECT_FALSE(box_at(none, {}));
  EXPECT_FALSE(box_rect(none, 1));
}

TEST(VitruvianGrid, HasNoBoxOfANumberBeyondTheGrid) {
  const BodyMap map = map_of(face, 200);
  EXPECT_FALSE(box_rect(map, 0));
  EXPECT_TRUE(box_rect(map, 25));
  EXPECT_FALSE(box_rect(map, 26));
}

}  // namespace
}  // namespace telehug
