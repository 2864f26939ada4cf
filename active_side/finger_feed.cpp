// SPDX-License-Identifier: Apache-2.0
#include "finger_feed.hpp"

#include <algorithm>
#include <utility>

#include "common/names.hpp"

namespace telehug {

using Json = nlohmann::json;

void FingerFeed::put(const ContactStates& contacts, Timestamp frame_time) {
  // A full queue loses a frame, which its number tells.
  if (wanted_) fresh_.push({++sequence_, frame_time, contacts});
}

void FingerFeed::follow(bool followed, Timestamp now) {
  if (followed) {
    followed_ = now;
    wanted_ = true;
  } else if (wanted_ && now - followed_ >= lingers) {
    wanted_ = false;
    over_ = true;
  }
}

std::optional<Json> FingerFeed::news() {
  const std::size_t fresh = fresh_.consume_all([this](const FingerFrame& frame) { newest_.push_back(frame); });
  if (!wanted_) {
    newest_.clear();
    if (!std::exchange(over_, false)) return std::nullopt;
    return Json{{"frames", Json::array()}};
  }
  if (fresh == 0) return std::nullopt;
  const std::size_t told = std::min(newest_.size(), std::max(fresh, repeated));
  Json frames = Json::array();
  for (std::size_t i = newest_.size() - told; i < newest_.size(); ++i) {
    const FingerFrame& frame = newest_[i];
    Json contacts = Json::array();
    for (const ContactState& contact : frame.contacts)
      contacts.push_back({{"id", contact.id},
                          {"phase", name_of(contact.phase)},
                          {"x_mm", contact.screen.x_mm},
                          {"y_mm", contact.screen.y_mm}});
    frames.push_back(
        {{"sequence", frame.sequence}, {"frame_time_ns", to_ns(frame.time)}, {"contacts", std::move(contacts)}});
  }
  return Json{{"frames", std::move(frames)}};
}

}  // namespace telehug
