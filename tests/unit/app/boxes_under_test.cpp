// SPDX-License-Identifier: Apache-2.0
#include "boxes_under.hpp"

#include <gtest/gtest.h>

#include "body_map/vitruvian_grid.hpp"

namespace telehug {
namespace {

constexpr Timestamp now = from_ns(10'000'000'000);
constexpr Duration max_age = 3s;

// A face 60 mm high: boxes of 30 mm, the grid from (125, 80) to (275, 300).
BodyMap map_seen(Timestamp when) {
  BodyMap map = make_body_map({160, 20, 80, 60}, {0, 0, 400, 300}).value();
  map.version = 7;
  map.seen = when;
  return map;
}

ContactState contact(std::uint32_t id, Phase phase, ScreenPoint at) {
  return {.id = id, .phase = phase, .screen = at, .speed_mm_s = 12, .frame_time = now};
}

constexpr ScreenPoint inside{200, 155};
constexpr ScreenPoint outside{20, 155};

class BoxesUnder : public testing::Test {
 protected:
  // A contact from down to up.
  void whole_life(const BodyMap& map, ScreenPoint at) {
    for (const Phase phase : {Phase::down, Phase::move, Phase::move, Phase::up})
      boxed = boxes_under({contact(1, phase, at)}, map, max_age, now, nobody);
  }
  [[nodiscard]] std::array<std::uint64_t, 3> counted() const {
    return {nobody.no_face, nobody.map_too_old, nobody.outside_grid};
  }
  using Counts = std::array<std::uint64_t, 3>;

  NobodyTouched nobody;
  BoxedContacts boxed;
};

TEST_F(BoxesUnder, NamesTheBoxAndThePlaceOnTheBody) {
  boxed = boxes_under({contact(3, Phase::move, inside)}, map_seen(now), max_age, now, nobody);
  ASSERT_EQ(boxed.size(), 1U);
  EXPECT_EQ(boxed[0].id, 3U);
  EXPECT_EQ(boxed[0].phase, Phase::move);
  EXPECT_EQ(boxed[0].box, 13);
  EXPECT_DOUBLE_EQ(boxed[0].body.x_fh, 0);
  EXPECT_DOUBLE_EQ(boxed[0].body.y_fh, 1.25);
  EXPECT_DOUBLE_EQ(boxed[0].screen.y_mm, 155);
  EXPECT_DOUBLE_EQ(boxed[0].speed_mm_s, 12);
  EXPECT_EQ(counted(), (Counts{0, 0, 0}));
}

TEST_F(BoxesUnder, CountsATouchWithoutAFaceOnce) {
  whole_life(BodyMap{}, inside);
  EXPECT_TRUE(boxed.empty());
  EXPECT_EQ(counted(), (Counts{1, 0, 0}));
}

TEST_F(BoxesUnder, CountsATouchOnAMapThatIsTooOldOnce) {
  whole_life(map_seen(now - max_age - 1ns), inside);
  EXPECT_TRUE(boxed.empty());
  EXPECT_EQ(counted(), (Counts{0, 1, 0}));
}

TEST_F(BoxesUnder, TakesAMapOfJustTheGreatestAge) {
  whole_life(map_seen(now - max_age), inside);
  EXPECT_EQ(boxed.size(), 1U);
  EXPECT_EQ(counted(), (Counts{0, 0, 0}));
}

TEST_F(BoxesUnder, CountsATouchBesideTheGridOnce) {
  whole_life(map_seen(now), outside);
  EXPECT_TRUE(boxed.empty());
  EXPECT_EQ(counted(), (Counts{0, 0, 1}));
}

TEST_F(BoxesUnder, TreatsEachContactByItself) {
  boxed = boxes_under(
      {contact(1, Phase::down, outside), contact(2, Phase::down, inside), contact(4, Phase::down, {130, 290})},
      map_seen(now), max_age, now, nobody);
  ASSERT_EQ(boxed.size(), 2U);
  EXPECT_EQ(boxed[0].id, 2U);
  EXPECT_EQ(boxed[1].id, 4U);
  EXPECT_EQ(boxed[1].box, 36);
  EXPECT_EQ(counted(), (Counts{0, 0, 1}));
}

}  // namespace
}  // namespace telehug
