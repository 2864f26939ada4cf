// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/clock.hpp"
#include "common/messages.hpp"

namespace telehug {

// What pages show of the touches that go out now, and of what the wearers answer. One thread.
class LiveTouches {
 public:
  // A contact as it was sent.
  void sent(const Contact& contact, Timestamp now);
  // `wearer`: what this PC calls them; empty: they have no name.
  void felt(const Felt& answer, const std::string& wearer);
  // Contacts of which nothing has been heard for a second: their end got lost on the way to here.
  void forget(Timestamp now);

  // If it has changed since it was last asked for: {"contacts": [{"contact", "box", "gesture", "x_fh", "y_fh",
  // "answers": [{"wearer", "outcome"}]}], "answer": {"box", "outcome", "wearer"}}. "answer": the newest, also of a
  // contact that has ended; absent: none has come yet.
  [[nodiscard]] std::optional<nlohmann::json> news();

 private:
  using Answers = std::vector<std::pair<std::string, FeltOutcome>>;  // the newest of each wearer
  struct Live {
    Contact contact;
    Timestamp heard;
    Answers answers;
  };
  struct Answer {
    std::uint16_t box = 0;
    FeltOutcome outcome = FeltOutcome::driven;
    std::string wearer;
    friend bool operator==(const Answer&, const Answer&) = default;
  };

  Live* find(std::uint32_t contact);
  void take(Answers& answers, const std::string& wearer, FeltOutcome outcome);

  std::vector<Live> live_;  // max_contacts at most
  // An answer may be here before the touch thread has told of its contact: of the newest few, until it does.
  std::vector<std::pair<std::uint32_t, Answer>> early_;
  std::optional<Answer> answer_;
  bool changed_ = true;
};

}  // namespace telehug
