// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/messages.hpp"
#include "config/reload.hpp"

namespace telehug {

// What came of the last time that the configuration was read anew, until the next: told in the log at once, and in
// every status. Any thread.
class ReloadNotes {
 public:
  explicit ReloadNotes(Side side) : side_(side) {}

  // `faults`: a sentence a line, "file:line: what" where they have a place. All is as it was.
  void refused(const std::string& faults);
  void taken(const std::vector<KeyChange>& changes);

  // Each fault, and each key that needs a restart.
  void add_problems(nlohmann::json& problems) const;

 private:
  const Side side_;
  mutable std::mutex mutex_;
  std::vector<std::string> faults_;   // guarded by mutex_
  std::vector<std::string> waiting_;  // likewise: sentences on keys that need a restart
};

}  // namespace telehug
