// SPDX-License-Identifier: Apache-2.0
//
// What a daemon does about its configuration on SIGHUP.
#pragma once

#include <spdlog/spdlog.h>

#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "config/reload.hpp"
#include "service/log.hpp"

namespace telehug {

// Reads the configuration anew and says in the log what comes of it: every key that is another now, every one that
// needs a restart, or every fault with its file and line, after which all is as it was. Also the log's level follows.
template <typename Config>
class ConfigReload {
 public:
  using Load = std::function<Result<Config>()>;

  // `live` beside "log.level": see reloaded().
  ConfigReload(Config used, LiveKeys live, Load load)
      : used_(std::move(used)), live_(std::move(live)), load_(std::move(load)) {
    live_.emplace_back("log.level");
  }

  // What is to be used from now on; nothing if that is what was used before.
  [[nodiscard]] std::optional<Config> again() {
    const auto read = load_();
    if (!read) return keep(read.error().message);
    auto next = reloaded(used_, *read, live_);
    if (!next) return keep(next.error().message);
    bool changed = false;
    for (const KeyChange& change : next->changes) {
      changed = changed || change.now;
      if (change.now) {
        spdlog::info("configuration: {} is {} now, was {}", change.path, change.after, change.before);
      } else {
        spdlog::warn("configuration: {} = {} needs a restart; {} is still in use", change.path, change.after,
                     change.before);
      }
    }
    if (next->changes.empty()) spdlog::info("configuration: read anew, nothing has changed");
    if (!changed) return std::nullopt;
    used_ = std::move(next->config);
    set_log_level(used_.log.level);
    return used_;
  }

 private:
  std::nullopt_t keep(const std::string& faults) const {
    std::istringstream lines(faults);
    for (std::string line; std::getline(lines, line);)
      spdlog::error("configuration: {}", line);
    spdlog::error("configuration: not taken, the one before stays in use");
    return std::nullopt;
  }

  Config used_;
  LiveKeys live_;
  Load load_;
};

}  // namespace telehug
