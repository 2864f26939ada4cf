// SPDX-License-Identifier: Apache-2.0
#include "daemon/stranger_note.hpp"

#include <algorithm>

namespace telehug {

void StrangerNote::look(const std::optional<Stranger>& seen, std::uint64_t refusals,
                        const std::set<std::string>& own_addresses, Timestamp now) {
  const bool own = seen && std::ranges::any_of(own_addresses, [&](const std::string& address) {
                     return address.ends_with(" " + seen->address);
                   });
  const std::lock_guard lock(mutex_);
  refusals_ = refusals;
  if (seen && !own) {
    stranger_ = seen;
    seen_at_ = now;
  } else if (stranger_ && now - seen_at_ >= remembered_for) {
    stranger_.reset();
  }
}

void StrangerNote::participant_replaced() {
  const std::lock_guard lock(mutex_);
  refusals_before_ += refusals_;
  refusals_ = 0;
}

std::optional<Stranger> StrangerNote::stranger() const {
  const std::lock_guard lock(mutex_);
  return stranger_;
}

std::uint64_t StrangerNote::refusals() const {
  const std::lock_guard lock(mutex_);
  return refusals_before_ + refusals_;
}

}  // namespace telehug
