// SPDX-License-Identifier: Apache-2.0
#include "touched_box.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

Contact contact(std::uint32_t id, Phase phase, std::uint16_t box) {
  Contact made;
  made.id = id;
  made.phase = phase;
  made.box = box;
  return made;
}

Felt answer(std::uint32_t id, FeltOutcome outcome = FeltOutcome::driven) {
  Felt felt;
  felt.contact_id = id;
  felt.outcome = outcome;
  return felt;
}

TEST(TouchedBox, IsShownFromDownToUpWhereverTheFingerGoes) {
  TouchedBox touched;
  EXPECT_FALSE(touched.shown());
  touched.sent(contact(1, Phase::down, 7));
  EXPECT_EQ(touched.shown()->box, 7);
  touched.sent(contact(1, Phase::move, 8));
  EXPECT_EQ(touched.shown()->box, 8);
  touched.sent(contact(1, Phase::up, 8));
  EXPECT_FALSE(touched.shown());
}

TEST(TouchedBox, IsFeltOnceTheOtherSideHasDrivenIt) {
  TouchedBox touched;
  touched.sent(contact(1, Phase::down, 7));
  touched.felt(answer(1, FeltOutcome::uncovered));
  touched.felt(answer(2));
  EXPECT_FALSE(touched.shown()->felt);
  touched.felt(answer(1));
  EXPECT_TRUE(touched.shown()->felt);
  touched.sent(contact(1, Phase::move, 8));
  EXPECT_TRUE(touched.shown()->felt) << "the contact goes on";
}

TEST(TouchedBox, IsFeltAlsoIfTheAnswerIsHereBeforeTheContact) {
  TouchedBox touched;
  touched.felt(answer(1));
  touched.sent(contact(1, Phase::down, 7));
  EXPECT_TRUE(touched.shown()->felt);
  touched.sent(contact(2, Phase::down, 8));
  EXPECT_FALSE(touched.shown()->felt);
}

TEST(TouchedBox, IsThatOfTheFingerThatCameLast) {
  TouchedBox touched;
  touched.sent(contact(1, Phase::down, 7));
  touched.felt(answer(1));
  touched.sent(contact(2, Phase::down, 12));
  touched.sent(contact(1, Phase::move, 8));
  EXPECT_EQ(touched.shown()->box, 12);
  EXPECT_FALSE(touched.shown()->felt);
  touched.sent(contact(1, Phase::up, 8));
  EXPECT_EQ(touched.shown()->box, 12);
  touched.sent(contact(2, Phase::up, 12));
  EXPECT_FALSE(touched.shown());
}

TEST(TouchedBox, IsNoneAfterTheSendingHasEnded) {
  TouchedBox touched;
  touched.sent(contact(1, Phase::down, 7));
  touched.clear();
  touched.felt(answer(1));
  EXPECT_FALSE(touched.shown());
}

}  // namespace
}  // namespace telehug
