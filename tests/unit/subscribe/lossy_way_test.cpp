// SPDX-License-Identifier: Apache-2.0
//
// Sender and receiver together over a way that loses, doubles and reorders events.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "doubles/example_messages.hpp"
#include "publish/touch_event_builder.hpp"
#include "subscribe/touch_order.hpp"

namespace telehug {
namespace {

using Key = std::tuple<std::uint32_t, Phase>;  // contact ids are used once here

// Three fingers that come and go at random; each stays up or down for at least two frames.
class Fingers {
 public:
  explicit Fingers(std::mt19937& random) : random_(random) {}

  BoxedContacts next_frame(bool may_come) {
    BoxedContacts contacts;
    for (Finger& finger : fingers_) {
      ++finger.frames;
      const bool change = finger.frames >= 2 && random_() % 3 == 0;
      if (finger.id == 0 && change && may_come) {
        finger = {.id = next_id_++, .frames = 0};
        contacts.push_back(boxed(finger.id, Phase::down));
      } else if (finger.id != 0) {
        contacts.push_back(boxed(finger.id, change ? Phase::up : Phase::move));
        if (change) finger = {};
      }
    }
    return contacts;
  }

  [[nodiscard]] std::uint32_t touches() const { return next_id_ - 1; }

 private:
  struct Finger {
    std::uint32_t id = 0;  // 0: not touching
    int frames = 0;
  };
  static BoxedContact boxed(std::uint32_t id, Phase phase) {
    return {.id = id, .phase = phase, .screen = {}, .speed_mm_s = 0, .grid = {5, 4}, .box = 7, .body = {}};
  }

  std::mt19937& random_;
  std::array<Finger, 3> fingers_;
  std::uint32_t next_id_ = 1;
};

// Events under way, by their time of arrival.
struct Packet {
  std::int64_t arrival_ms;
  TouchEvent event;
  bool operator>(const Packet& other) const { return arrival_ms > other.arrival_ms; }
};

class LossyWay : public testing::TestWithParam<unsigned> {
 protected:
  // Plays touches at 30 Hz for a while. lose(sequence): is this event lost? Events are late by up to max_delay_ms.
  void play(int frames, int max_delay_ms, const std::function<bool(std::uint64_t)>& lose) {
    std::priority_queue<Packet, std::vector<Packet>, std::greater<>> way;
    Fingers fingers(random);
    TouchEventBuilder builder(example_session);
    constexpr int quiet_frames = 40;
    for (int frame = 0; frame < frames + quiet_frames; ++frame) {
      const std::int64_t now_ms = 1000 + 33 * frame;
      const Timestamp now = from_ns(now_ms * 1'000'000);
      const TouchEvent* event = builder.build(fingers.next_frame(frame < frames), 1, now, now);
      if (event != nullptr && !lose(event->sequence)) {
        const int copies = random() % 5 == 0 ? 2 : 1;
        for (int copy = 0; copy < copies; ++copy) {
          way.push({now_ms + static_cast<int>(random() % static_cast<unsigned>(max_delay_ms + 1)), *event});
        }
      }
      for (; !way.empty() && way.top().arrival_ms <= now_ms; way.pop())
        arrive(way.top().event);
    }
    for (; !way.empty(); way.pop())
      arrive(way.top().event);
    touches = fingers.touches();
  }

  void arrive(const TouchEvent& event) {
    const OrderedTouch* ordered = order.accept(event);
    if (ordered == nullptr) return;
    for (const Transition& transition : ordered->transitions) {
      const Contact& contact = transition.contact;
      ++delivered[{contact.id, contact.phase}];
      if (contact.phase == Phase::down) {
        felt_down.insert(contact.id);
      } else {
        felt_down.erase(contact.id);
      }
    }
    for (const std::uint32_t id : ordered->ended)
      felt_down.erase(id);
    for (const std::uint32_t id : felt_down) {
      const bool touching = std::any_of(event.contacts.begin(), event.contacts.end(),
                                        [id](const Contact& contact) { return contact.id == id; });
      EXPECT_TRUE(touching) << "contact " << id << " is over, but nobody said so";
    }
  }

  std::mt19937 random{GetParam()};
  TouchOrder order;
  std::map<Key, int> delivered;
  std::set<std::uint32_t> felt_down;
  std::uint32_t touches = 0;
};

TEST_P(LossyWay, EveryDownAndUpIsDeliveredExactlyOnceIfNoMoreThanTwoEventsInARowAreLost) {
  int lost_in_a_row = 0;
  play(600, 60, [&](std::uint64_t) {
    const bool lost = lost_in_a_row < 2 && random() % 2 == 0;
    lost_in_a_row = lost ? lost_in_a_row + 1 : 0;
    return lost;
  });
  ASSERT_GT(touches, 50U);
  for (std::uint32_t id = 1; id <= touches; ++id) {
    EXPECT_EQ((delivered[{id, Phase::down}]), 1) << "down of contact " << id;
    EXPECT_EQ((delivered[{id, Phase::up}]), 1) << "up of contact " << id;
  }
  EXPECT_TRUE(felt_down.empty());
  EXPECT_GT(order.counters().recovered, 0U);
  EXPECT_GT(order.counters().duplicates, 0U);
  EXPECT_GT(order.counters().overtaken, 0U);
}

TEST_P(LossyWay, NothingIsDeliveredTwiceAndNoContactIsLeftOverWhateverIsLost) {
  bool cut = false;
  play(600, 200, [&](std::uint64_t) {
    if (random() % 20 == 0) cut = !cut;  // for 20 events on average, longer than transitions are repeated
    return cut;
  });
  for (const auto& [key, times] : delivered)
    EXPECT_EQ(times, 1) << "contact " << std::get<0>(key);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LossyWay, testing::Range(1U, 41U));

}  // namespace
}  // namespace telehug
