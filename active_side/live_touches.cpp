// SPDX-License-Identifier: Apache-2.0
#include "live_touches.hpp"

#include <algorithm>

#include "common/names.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr Duration longest_silence = 1s;

}  // namespace

LiveTouches::Live* LiveTouches::find(std::uint32_t contact) {
  const auto at = std::ranges::find(live_, contact, [](const Live& live) { return live.contact.id; });
  return at == live_.end() ? nullptr : &*at;
}

void LiveTouches::sent(const Contact& contact, Timestamp now) {
  Live* const known = find(contact.id);
  if (contact.phase == Phase::up) {
    changed_ = changed_ || known != nullptr;
    std::erase_if(live_, [&](const Live& live) { return live.contact.id == contact.id; });
    return;
  }
  changed_ = true;
  if (known != nullptr) {
    known->contact = contact;
    known->heard = now;
    return;
  }
  if (live_.size() == max_contacts) live_.erase(live_.begin());
  live_.push_back({contact, now, {}});
}

void LiveTouches::felt(const Felt& answer, const std::string& wearer) {
  if (answer.phase == Phase::up) return;  // that a touch is over is no answer to it
  Answer newest{answer.box, answer.outcome, wearer};
  if (answer_ != newest) {
    answer_ = std::move(newest);
    changed_ = true;
  }
  Live* const live = find(answer.contact_id);
  if (live == nullptr) return;
  const auto known = std::ranges::find(live->answers, wearer, &Answers::value_type::first);
  if (known == live->answers.end()) {
    live->answers.emplace_back(wearer, answer.outcome);
    changed_ = true;
  } else if (known->second != answer.outcome) {
    known->second = answer.outcome;
    changed_ = true;
  }
}

void LiveTouches::forget(Timestamp now) {
  if (std::erase_if(live_, [now](const Live& live) { return now - live.heard > longest_silence; }) > 0) changed_ = true;
}

std::optional<Json> LiveTouches::news() {
  if (!std::exchange(changed_, false)) return std::nullopt;
  Json contacts = Json::array();
  for (const Live& live : live_) {
    Json answers = Json::array();
    for (const auto& [wearer, outcome] : live.answers)
      answers.push_back({{"wearer", wearer}, {"outcome", name_of(outcome)}});
    contacts.push_back({{"contact", live.contact.id},
                        {"box", live.contact.box},
                        {"gesture", name_of(live.contact.gesture)},
                        {"x_fh", live.contact.body.x_fh},
                        {"y_fh", live.contact.body.y_fh},
                        {"answers", std::move(answers)}});
  }
  Json news = {{"contacts", std::move(contacts)}};
  if (answer_)
    news["answer"] = {{"box", answer_->box}, {"outcome", name_of(answer_->outcome)}, {"wearer", answer_->wearer}};
  return news;
}

}  // namespace telehug
