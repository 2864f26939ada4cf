// SPDX-License-Identifier: Apache-2.0
#include "safety/muted_place.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

MutedBoxes boxes(std::initializer_list<std::size_t> numbers) {
  MutedBoxes made;
  for (const std::size_t number : numbers)
    made.set(number);
  return made;
}

TEST(MutedPlace, is_the_box_of_the_touch_and_no_other) {
  for (int box = 1; box <= 20; ++box)
    EXPECT_EQ(is_muted(contact_in(box), boxes({8, 13})), box == 8 || box == 13) << box;
  EXPECT_FALSE(is_muted(contact_in(8), {}));
}

TEST(MutedPlace, is_also_where_a_grid_of_another_shape_puts_the_touch) {
  Contact contact = contact_in(8);
  contact.grid = {10, 8};
  contact.box = 25;
  EXPECT_TRUE(is_muted(contact, boxes({8})));
  EXPECT_FALSE(is_muted(contact, boxes({25}))) << "that is of another grid";
}

TEST(MutedPlace, holds_against_a_box_and_a_place_that_do_not_belong_together) {
  Contact contact = contact_in(8);
  contact.box = 7;
  EXPECT_TRUE(is_muted(contact, boxes({8})));
  EXPECT_TRUE(is_muted(contact, boxes({7})));
}

TEST(MutedPlace, holds_for_an_actuator_that_lies_in_it) {
  Permission permission;
  permission.muted_boxes = boxes({8, 13});
  for (int box = 1; box <= 20; ++box)
    EXPECT_EQ(is_muted(1, middle_of(box), permission), box == 8 || box == 13) << box;
  EXPECT_TRUE(is_muted(1, {-0.25, 0.5}, permission)) << "its upper left corner is a part of it";
  EXPECT_FALSE(is_muted(1, {0.25, 0.5}, permission)) << "the next box begins there";
  permission.muted_actuators.set(3);
  EXPECT_TRUE(is_muted(3, middle_of(1), permission));
  EXPECT_FALSE(is_muted(2, middle_of(1), permission));
}

TEST(MutedPlace, bears_any_place_and_box) {
  MutedBoxes all;
  all.set();
  constexpr double odd[]{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300,
                         1e300};
  for (const double x : odd) {
    for (const double y : odd) {
      Contact contact = contact_in(8);
      contact.box = 65535;
      contact.body = {x, y};
      EXPECT_FALSE(is_muted(contact, all));
      EXPECT_FALSE(is_muted(1, contact.body, {{}, all, {}}));
    }
  }
}

}  // namespace
}  // namespace telehug
