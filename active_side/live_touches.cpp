// SPDX-License-Identifier: Apache-2.0
#include "live_touches.hpp"

#include <algorithm>

#include "common/names.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr Duration longest_silence = 1s;
constexpr std::size_t most_early = 2 * max_contacts;

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
  Live& fresh = live_.emplace_back(Live{contact, now, {}});
  for (const auto& [id, answer] : early_)
    if (id == contact.id) take(fresh.answers, answer.wearer, answer.outcome);
  std::erase_if(early_, [&](const auto& early) { return early.first == contact.id; });
}

void LiveTouches::take(Answers& answers, const std::string& wearer, FeltOutcome outcome) {
  const auto known = std::ranges::find(answers, wearer, &Answers::value_type::first);
  if (known == answers.end()) {
    answers.emplace_back(wearer, outcome);
    changed_ = true;
  } else if (known->second != outcome) {
    known->second = outcome;
    changed_ = true;
  }
}

void LiveTouches::felt(const Felt& answer, const std::string& wearer) {
  if (answer.phase == Phase::up) return;  // that a touch is over is no answer to it
  Answer newest{answer.box, answer.outcome, wearer};
  Live* const live = find(answer.contact_id);
  if (live != nullptr) {
    take(live->answers, wearer, answer.outcome);
  } else {
    if (early_.size() == most_early) early_.erase(early_.begin());
    early_.emplace_back(answer.contact_id, newest);
  }
  if (answer_ == newest) return;
  answer_ = std::move(newest);
  changed_ = true;
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
