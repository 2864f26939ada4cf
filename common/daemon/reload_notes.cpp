// SPDX-License-Identifier: Apache-2.0
#include "daemon/reload_notes.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "daemon/status_parts.hpp"
#include "service/control_socket.hpp"
#include "service/log.hpp"

namespace telehug {
namespace {

constexpr LogFields plain{.stage = "config"};
constexpr LogFields refusal{.stage = "config", .message_id = message_id::configuration_refused};
constexpr LogFields success{.stage = "config", .message_id = message_id::configuration_taken};

}  // namespace

void ReloadNotes::refused(const std::string& faults) {
  std::vector<std::string> sentences;
  std::istringstream lines(faults);
  for (std::string line; std::getline(lines, line);)
    sentences.push_back("configuration: " + line);
  for (const std::string& sentence : sentences)
    log_about(plain, spdlog::level::err, sentence);
  log_about(refusal, spdlog::level::err, "configuration: not taken, the one before stays in use");
  const std::lock_guard lock(mutex_);
  faults_ = std::move(sentences);
}

void ReloadNotes::taken(const std::vector<KeyChange>& changes) {
  std::vector<std::string> waiting;
  for (const KeyChange& change : changes) {
    if (change.now) {
      log_about(plain, spdlog::level::info,
                fmt::format("configuration: {} is {} now, was {}", change.path, change.after, change.before));
    } else {
      waiting.push_back(fmt::format("configuration: {} = {} needs a restart; {} is still in use", change.path,
                                    change.after, change.before));
      log_about(plain, spdlog::level::warn, waiting.back());
    }
  }
  log_about(success, spdlog::level::info,
            changes.empty() ? "configuration: read anew, nothing has changed" : "configuration: read anew");
  const std::lock_guard lock(mutex_);
  faults_.clear();
  waiting_ = std::move(waiting);
}

void ReloadNotes::add_problems(nlohmann::json& problems) const {
  const std::string daemon = "telehug-" + side_name(side_);
  const std::lock_guard lock(mutex_);
  for (const std::string& fault : faults_) {
    problems.push_back(
        problem_json(fault, "what was in use before still is; correct it and reload " + daemon + " once more"));
  }
  for (const std::string& key : waiting_)
    problems.push_back(problem_json(key, "start " + daemon + " again when it suits"));
}

}  // namespace telehug
