// SPDX-License-Identifier: Apache-2.0
//
// How exactly the shipped jacket lets touches be felt where they are. tests/bench/run rendering prints it for all.
#include <gtest/gtest.h>

#include "bench/rendering/accuracy.hpp"
#include "bench/rendering/accuracy_picture.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "unit/rendering/rendering_builders.hpp"

namespace telehug {
namespace {

JacketProfile shipped(Rendering rendering) {
  auto profile = load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml");
  if (!profile) throw std::runtime_error(profile.error().message);
  profile->rendering = rendering;
  return std::move(profile).value();
}

TEST(Accuracy, is_as_good_as_the_least_that_is_felt_between_motors) {
  const AccuracySummary drives = summarise(measure_accuracy(shipped(Rendering::places), Seen::drives), true);
  EXPECT_GT(drives.touches, 100U);
  EXPECT_EQ(drives.uncovered, 0U);
  EXPECT_LT(drives.most_fh, 0.002) << "what is too weak to be felt is left off";
}

TEST(Accuracy, is_a_twentieth_of_a_face_in_the_steps_of_the_microcontroller) {
  const AccuracySummary steps = summarise(measure_accuracy(shipped(Rendering::places), Seen::steps), true);
  EXPECT_LT(steps.mean_fh, 0.02);
  EXPECT_LT(steps.most_fh, 0.05);
}

TEST(Accuracy, of_boxes_is_that_of_their_motors_places) {
  const AccuracySummary boxes = summarise(measure_accuracy(shipped(Rendering::boxes), Seen::drives), true);
  EXPECT_GT(boxes.mean_fh, 0.15);
  EXPECT_LT(boxes.mean_fh, 0.3);
}

TEST(Accuracy, counts_what_is_felt_nowhere) {
  const JacketProfile profile = places_of({motor(1, {0, 1}, {})});
  const auto places = measure_accuracy(profile, Seen::drives, 0.25);
  EXPECT_EQ(places.size(), 80U);
  const AccuracySummary sum = summarise(places, false);
  EXPECT_EQ(sum.touches - sum.uncovered, 4U);
  EXPECT_DOUBLE_EQ(sum.mean_fh, std::hypot(0.125, 0.125));
  EXPECT_EQ(summarise(places, true).touches, 0U);
}

TEST(Accuracy, is_drawn_with_every_motor_and_touch) {
  const JacketProfile profile = places_of({motor(11, {0, 1}, {}), motor(12, {0.5, 1}, {})});
  const std::string svg = accuracy_picture(profile, measure_accuracy(profile, Seen::drives, 0.5), "a < b & c", "none");
  const auto count = [&svg](const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = svg.find(part); at != std::string::npos; at = svg.find(part, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("class=\"motor\""), 2U);
  EXPECT_EQ(count("class=\"touch\"") + count("class=\"nowhere\""), 20U);
  EXPECT_EQ(count(">11</text>"), 1U);
  EXPECT_EQ(count("a &lt; b &amp; c"), 1U);
}

}  // namespace
}  // namespace telehug
