// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "wire/wire.hpp"

namespace telehug {

// How a link comes to its wire: all in which a serial port and Bluetooth differ. One thread uses it; nothing waits.
class WireOpener {
 public:
  virtual ~WireOpener() = default;

  // Begins to open the wire or goes on with it: the wire, why there is none, or nothing as long as it is not decided.
  // After a wire or an error the next call begins anew.
  [[nodiscard]] virtual std::optional<Result<Wire>> open(Timestamp now) = 0;

  // What it opens, for people.
  [[nodiscard]] virtual const std::string& device() const = 0;
  // What it is doing while open() returns nothing; half a sentence.
  [[nodiscard]] virtual const std::string& progress() const = 0;
  // What to do when a wire that stood breaks; half a sentence.
  [[nodiscard]] virtual const std::string& lost_advice() const = 0;
};

}  // namespace telehug
