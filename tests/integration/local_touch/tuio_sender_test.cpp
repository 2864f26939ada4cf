// SPDX-License-Identifier: Apache-2.0
#include "local_touch/tuio_sender.hpp"

#include <gmock/gmock.h>

#include "doubles/tuio_listener.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::FloatNear;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr ScreenSize screen{400, 300, 0, 0};

ContactState contact(std::uint32_t id, Phase phase, ScreenPoint at) {
  return {.id = id, .phase = phase, .screen = at, .frame_time = {}};
}

class Tuio : public testing::Test {
 protected:
  Tuio() { EXPECT_TRUE(sender_.open(screen)); }
  TuioListener::Bundle send(const ContactStates& contacts) {
    listener_.bundles();
    now_ += 100ms;
    EXPECT_TRUE(sender_.send(contacts, now_));
    const auto bundles = listener_.bundles();
    EXPECT_EQ(bundles.size(), 1U);
    return bundles.empty() ? TuioListener::Bundle{} : bundles.back();
  }

  TuioListener listener_;
  TuioSender sender_{{"127.0.0.1", listener_.port()}};
  Timestamp now_{1s};
};

TEST_F(Tuio, BeginsWithABundleThatSaysWhoSends) {
  const auto bundles = listener_.bundles();
  ASSERT_EQ(bundles.size(), 1U);
  EXPECT_THAT(bundles[0].source, StartsWith("telehug@"));
  EXPECT_THAT(bundles[0].alive, IsEmpty());
  EXPECT_EQ(bundles[0].fseq, 1);
}

TEST_F(Tuio, TellsWhereEachFingerIsHowFastAndHowMuchFaster) {
  auto bundle = [&] {
    listener_.bundles();
    EXPECT_TRUE(sender_.send({contact(3, Phase::down, {100, 150})}, now_ += 100ms));
    return listener_.bundles().at(0);
  }();
  EXPECT_THAT(bundle.alive, ElementsAre(3));
  EXPECT_THAT(bundle.set[3], ElementsAre(FloatEq(0.25), FloatEq(0.5), 0, 0, 0));
  EXPECT_EQ(bundle.fseq, 2);

  EXPECT_TRUE(sender_.send({contact(3, Phase::move, {120, 135}), contact(4, Phase::down, {400, 0})}, now_ += 100ms));
  bundle = listener_.bundles().at(0);
  EXPECT_THAT(bundle.alive, ElementsAre(3, 4));
  // 0.05 of the width and -0.05 of the height in 0.1 s, from rest.
  EXPECT_THAT(bundle.set[3], ElementsAre(FloatEq(0.3F), FloatEq(0.45F), FloatNear(0.5F, 1e-4F), FloatNear(-0.5F, 1e-4F),
                                         FloatNear(7.07F, 0.01F)));
  EXPECT_THAT(bundle.set[4], ElementsAre(1, 0, 0, 0, 0));
  EXPECT_EQ(bundle.fseq, 3);
}

TEST_F(Tuio, LiftsAFingerOnceAndThenIsQuietButForASignOfLife) {
  listener_.bundles();
  ASSERT_TRUE(sender_.send({contact(3, Phase::down, {100, 150})}, now_ += 100ms));
  ASSERT_TRUE(sender_.send({contact(3, Phase::up, {100, 150})}, now_ += 100ms));
  auto bundles = listener_.bundles();
  ASSERT_EQ(bundles.size(), 2U);
  EXPECT_THAT(bundles[1].alive, IsEmpty());
  EXPECT_EQ(bundles[1].fseq, 3);
  for (int i = 0; i < 9; ++i)
    ASSERT_TRUE(sender_.send({}, now_ += 100ms));
  EXPECT_TRUE(listener_.silent());
  ASSERT_TRUE(sender_.send({}, now_ += 100ms));
  bundles = listener_.bundles();
  ASSERT_EQ(bundles.size(), 1U);
  EXPECT_EQ(bundles[0].fseq, -1) << "it is no new frame";
}

TEST_F(Tuio, LiftsEverythingWhenItEnds) {
  listener_.bundles();
  ASSERT_TRUE(sender_.send({contact(3, Phase::down, {100, 150})}, now_ += 100ms));
  sender_.close();
  const auto bundles = listener_.bundles();
  ASSERT_EQ(bundles.size(), 2U);
  EXPECT_THAT(bundles[1].alive, IsEmpty());
}

TEST_F(Tuio, FitsTenFingersIntoOneDatagram) {
  ContactStates ten;
  for (std::uint32_t i = 1; i <= 10; ++i)
    ten.push_back(contact(i, Phase::down, {30.0 * i, 20}));
  listener_.bundles();
  ASSERT_TRUE(sender_.send(ten, now_ += 100ms));
  const auto bundles = listener_.bundles();
  ASSERT_EQ(bundles.size(), 1U);
  EXPECT_EQ(bundles[0].set.size(), 10U);
}

TEST(TuioAddress, ThatDoesNotExistIsSaidWithWhatToCheck) {
  TuioSender sender({"no-such-host.invalid", 3333});
  const Status opened = sender.open(screen);
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, testing::HasSubstr("no-such-host.invalid:3333"));
}

}  // namespace
}  // namespace telehug
