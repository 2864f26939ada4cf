// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "doubles/child_program.hpp"

namespace telehug {

// A program on Cyclone DDS, on loopback. Its last word is its own.
inline ChildProgram cyclone_program(const std::string& name, std::uint32_t domain, const std::string& partition,
                                    const std::string& word) {
  return {{TELEHUG_INTEROP_BIN "/" + name, std::to_string(domain), partition, word},
          {"CYCLONEDDS_URI=<General><Interfaces><NetworkInterface name=\"lo\" "
           "multicast=\"true\"/></Interfaces></General>"}};
}

// The wearer's side in cyclone/wearer_side.c.
class CycloneWearer {
 public:
  CycloneWearer(std::uint32_t domain, const std::string& partition, const std::string& session)
      : program_(cyclone_program("wearer_side", domain, partition, session)) {}

  // The next message of the active side that it heard by that topic. Null: none in time.
  nlohmann::json next(const std::string& topic, std::chrono::milliseconds longest = std::chrono::seconds(20)) {
    const auto give_up = std::chrono::steady_clock::now() + longest;
    while (heard_[topic].empty()) {
      const auto line = program_.read_line_within(
          std::chrono::ceil<std::chrono::milliseconds>(give_up - std::chrono::steady_clock::now()));
      if (!line) return nullptr;
      nlohmann::json message = nlohmann::json::parse(*line);
      heard_[message.at("topic")].push_back(std::move(message));
    }
    nlohmann::json message = std::move(heard_[topic].front());
    heard_[topic].pop_front();
    return message;
  }

  // The one of that number; those before it are forgotten. Null: it did not come in time after another.
  nlohmann::json next(const std::string& topic, std::uint64_t sequence) {
    nlohmann::json message = next(topic);
    while (!message.is_null() && message.at("sequence") != sequence)
      message = next(topic);
    return message;
  }

 private:
  ChildProgram program_;
  std::map<std::string, std::deque<nlohmann::json>> heard_;
};

}  // namespace telehug
