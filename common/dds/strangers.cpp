// SPDX-License-Identifier: Apache-2.0
#include "dds/strangers.hpp"

#include <algorithm>

namespace telehug {

void Strangers::discovered(const Id& id, const std::string& address, Timestamp now) {
  const std::lock_guard lock(mutex_);
  if (find(id) != nullptr || participants_.size() == most_remembered) return;
  participants_.push_back({id, address, now});
}

void Strangers::proved(const Id& id) {
  const std::lock_guard lock(mutex_);
  if (Participant* known = find(id)) known->standing = Standing::proved;
}

// Somebody whose handshake fails tries again each second. One who was proved keeps that: anybody can spoil a handshake
// in another's name.
void Strangers::refused(const Id& id) {
  const std::lock_guard lock(mutex_);
  Participant* known = find(id);
  if (known == nullptr || known->standing != Standing::unproved) return;
  known->standing = Standing::refused;
  ++refusals_;
}

void Strangers::gone(const Id& id) {
  const std::lock_guard lock(mutex_);
  std::erase_if(participants_, [&](const Participant& one) { return one.id == id; });
}

std::optional<Stranger> Strangers::longest_here(Timestamp now) const {
  const std::lock_guard lock(mutex_);
  for (const Participant& one : participants_) {
    const bool refused = one.standing == Standing::refused;
    const bool unproved = one.standing == Standing::unproved && now - one.since >= longest_handshake;
    if (refused || unproved) return Stranger{one.address, refused};
  }
  return std::nullopt;
}

std::uint64_t Strangers::refusals() const {
  const std::lock_guard lock(mutex_);
  return refusals_;
}

Strangers::Participant* Strangers::find(const Id& id) {
  const auto found = std::ranges::find(participants_, id, &Participant::id);
  return found == participants_.end() ? nullptr : &*found;
}

}  // namespace telehug
