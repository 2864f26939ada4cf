// SPDX-License-Identifier: Apache-2.0
//
// What a daemon does about its configuration on SIGHUP.
#pragma once

#include <algorithm>
#include <exception>
#include <functional>
#include <utility>

#include "common/result.hpp"
#include "config/reload.hpp"
#include "daemon/reload_notes.hpp"
#include "service/log.hpp"

namespace telehug {

// Reads the configuration anew and notes what comes of it: every key that is another now, every one that needs a
// restart, or every fault with its file and line, after which all is as it was. Also the log's level follows.
template <typename Config>
class ConfigReload {
 public:
  // Reads all files; the error names each fault.
  using Load = std::function<Result<Config>()>;
  // Takes the new configuration over, or says why it can't be used.
  using Use = std::function<Status(const Config& next)>;

  explicit ConfigReload(Load load) : load_(std::move(load)) {}

  // `used`: what is in use now. `use` is called if of that anything changes.
  void again(const Config& used, ReloadNotes& notes, const Use& use) const {
    const auto read = loaded();
    if (!read) return notes.refused(read.error().message);
    const auto next = reloaded(used, *read);
    if (!next) return notes.refused(next.error().message);
    if (std::ranges::any_of(next->changes, &KeyChange::now)) {
      if (const Status taken = use(next->config); !taken) return notes.refused(taken.error().message);
      set_log_level(next->config.log.level);
    }
    notes.taken(next->changes);
  }

 private:
  // What a file system throws must not end what runs.
  [[nodiscard]] Result<Config> loaded() const {
    try {
      return load_();
    } catch (const std::exception& problem) {
      return Error{problem.what()};
    }
  }

  const Load load_;
};

}  // namespace telehug
