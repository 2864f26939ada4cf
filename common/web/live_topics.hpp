// SPDX-License-Identifier: Apache-2.0
//
// What pages show as it changes. Of each topic there is the newest text and nothing before it: whoever reads slowly
// misses some, and nothing ever queues.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace telehug {

class LiveTopics {
 public:
  struct Newest {
    std::shared_ptr<const std::string> event;  // as server-sent events are written
    std::uint64_t version = 0;                 // grows with each text; 0: there is none yet
  };

  // Topics have to be named before they are told of or asked for.
  explicit LiveTopics(const std::vector<std::string>& names);

  // Any thread. `text` has one line.
  void tell(const std::string& topic, std::string_view text);

  [[nodiscard]] bool has(const std::string& topic) const { return topics_.contains(topic); }
  [[nodiscard]] Newest newest(const std::string& topic) const;

 private:
  std::map<std::string, Newest> topics_;  // its keys never change; the values are guarded by mutex_
  mutable std::mutex mutex_;
};

}  // namespace telehug
