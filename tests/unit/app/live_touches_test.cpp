// SPDX-License-Identifier: Apache-2.0
#include "live_touches.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr Timestamp start{};

Contact contact(std::uint32_t id, Phase phase, std::uint16_t box) {
  Contact made;
  made.id = id;
  made.phase = phase;
  made.box = box;
  made.body = {0.25, 1.5};
  made.gesture = Gesture::hold;
  return made;
}

Felt answer(std::uint32_t id, std::uint16_t box, FeltOutcome outcome, Phase phase = Phase::move) {
  Felt felt;
  felt.contact_id = id;
  felt.box = box;
  felt.outcome = outcome;
  felt.phase = phase;
  return felt;
}

TEST(LiveTouches, TellWhereTheFingerIsFromDownToUp) {
  LiveTouches live;
  EXPECT_EQ(live.news(), Json({{"contacts", Json::array()}})) << "a page that has just come knows nothing yet";
  live.sent(contact(1, Phase::down, 12), start);
  EXPECT_EQ(live.news()->at("contacts"), Json::array({{{"contact", 1},
                                                       {"box", 12},
                                                       {"gesture", "hold"},
                                                       {"x_fh", 0.25},
                                                       {"y_fh", 1.5},
                                                       {"answers", Json::array()}}}));
  live.sent(contact(1, Phase::move, 13), start);
  EXPECT_EQ(live.news()->at("contacts").at(0).at("box"), 13);
  live.sent(contact(1, Phase::up, 13), start);
  EXPECT_EQ(live.news()->at("contacts"), Json::array());
}

TEST(LiveTouches, HaveNothingToTellWhileNothingChanges) {
  LiveTouches live;
  (void)live.news();
  EXPECT_FALSE(live.news());
  live.sent(contact(9, Phase::up, 3), start);
  EXPECT_FALSE(live.news()) << "nobody knew of it";
  live.sent(contact(1, Phase::down, 12), start);
  live.felt(answer(1, 12, FeltOutcome::driven), "Mia");
  EXPECT_TRUE(live.news());
  live.felt(answer(1, 12, FeltOutcome::driven), "Mia");
  live.forget(start + 1s);
  EXPECT_FALSE(live.news());
}

TEST(LiveTouches, TellTheNewestAnswerOfEachWearer) {
  LiveTouches live;
  live.sent(contact(1, Phase::down, 12), start);
  live.felt(answer(1, 12, FeltOutcome::stale), "Mia");
  live.felt(answer(1, 12, FeltOutcome::paused), "Tom");
  live.felt(answer(1, 12, FeltOutcome::driven), "Mia");
  const Json news = *live.news();
  EXPECT_EQ(news.at("contacts").at(0).at("answers"),
            Json::array({{{"wearer", "Mia"}, {"outcome", "driven"}}, {{"wearer", "Tom"}, {"outcome", "paused"}}}));
  EXPECT_EQ(news.at("answer"), Json({{"box", 12}, {"outcome", "driven"}, {"wearer", "Mia"}}));
}

TEST(LiveTouches, KeepTheLastAnswerAfterTheTouch) {
  LiveTouches live;
  live.sent(contact(1, Phase::down, 12), start);
  live.sent(contact(1, Phase::up, 12), start);
  live.felt(answer(1, 12, FeltOutcome::muted), "");
  live.felt(answer(1, 12, FeltOutcome::driven, Phase::up), "");
  EXPECT_EQ(*live.news(),
            Json({{"contacts", Json::array()}, {"answer", {{"box", 12}, {"outcome", "muted"}, {"wearer", ""}}}}))
      << "the answer to its end says nothing of what was felt";
}

TEST(LiveTouches, KnowTheAnswerAlsoIfItIsHereBeforeTheContact) {
  LiveTouches live;
  for (std::uint32_t id = 50; id < 100; ++id)
    live.felt(answer(id, 3, FeltOutcome::stale), "Mia");
  live.felt(answer(1, 12, FeltOutcome::driven), "Mia");
  live.sent(contact(1, Phase::down, 12), start);
  const Json driven = Json::array({{{"wearer", "Mia"}, {"outcome", "driven"}}});
  EXPECT_EQ(live.news()->at("contacts").at(0).at("answers"), driven);
  live.sent(contact(2, Phase::down, 12), start);
  EXPECT_EQ(live.news()->at("contacts").at(1).at("answers"), Json::array()) << "it was not the answer to this one";
}

TEST(LiveTouches, ForgetAFingerWhoseEndGotLost) {
  LiveTouches live;
  live.sent(contact(1, Phase::down, 12), start);
  live.sent(contact(2, Phase::down, 13), start);
  live.sent(contact(1, Phase::move, 12), start + 900ms);
  live.forget(start + 1500ms);
  const Json contacts = live.news()->at("contacts");
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts.at(0).at("contact"), 1);
}

TEST(LiveTouches, AreNeverMoreThanAnEventHolds) {
  LiveTouches live;
  for (std::uint32_t id = 1; id <= max_contacts + 3; ++id)
    live.sent(contact(id, Phase::down, 1), start);
  const Json contacts = live.news()->at("contacts");
  ASSERT_EQ(contacts.size(), max_contacts);
  EXPECT_EQ(contacts.back().at("contact"), max_contacts + 3);
}

}  // namespace
}  // namespace telehug
