// SPDX-License-Identifier: Apache-2.0
#include "web/live_topics.hpp"

#include <fmt/core.h>

#include <utility>

namespace telehug {

LiveTopics::LiveTopics(const std::vector<std::string>& names) {
  for (const std::string& name : names)
    topics_[name] = {};
}

void LiveTopics::tell(const std::string& topic, std::string_view text) {
  // https://html.spec.whatwg.org/multipage/server-sent-events.html#parsing-an-event-stream
  auto event = std::make_shared<const std::string>(fmt::format("event: {}\ndata: {}\n\n", topic, text));
  const std::lock_guard lock(mutex_);
  Newest& newest = topics_.at(topic);
  newest.event = std::move(event);
  ++newest.version;
}

LiveTopics::Newest LiveTopics::newest(const std::string& topic) const {
  const std::lock_guard lock(mutex_);
  return topics_.at(topic);
}

}  // namespace telehug
