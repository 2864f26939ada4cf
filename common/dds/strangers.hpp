// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

// Another participant that does not belong with this one.
struct Stranger {
  std::string address;   // IPv4, as it announced itself, which proves nothing
  bool refused = false;  // by this side; false: the handshake with it does not come to an end
  friend bool operator==(const Stranger&, const Stranger&) = default;
};

// Who of the participants that announce themselves has not proved to be of this pair. Discovery is open to everybody,
// so it remembers only so many. Any thread.
class Strangers {
 public:
  using Id = std::array<std::uint8_t, 12>;

  // A handshake takes a second or two over a long way.
  static constexpr Duration longest_handshake = 3500ms;
  static constexpr std::size_t most_remembered = 64;

  void discovered(const Id& id, const std::string& address, Timestamp now);
  void proved(const Id& id);
  void refused(const Id& id);
  void gone(const Id& id);

  // The one that has been here longest; whoever takes long to prove itself only after a while.
  [[nodiscard]] std::optional<Stranger> longest_here(Timestamp now) const;
  // How many were refused, each counted once while it is remembered.
  [[nodiscard]] std::uint64_t refusals() const;

 private:
  enum class Standing : std::uint8_t { unproved, proved, refused };
  struct Participant {
    Id id;
    std::string address;
    Timestamp since;
    Standing standing = Standing::unproved;
  };

  [[nodiscard]] Participant* find(const Id& id);

  mutable std::mutex mutex_;
  std::vector<Participant> participants_;  // oldest first
  std::uint64_t refusals_ = 0;
};

}  // namespace telehug
