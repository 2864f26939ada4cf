// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/result.hpp"

namespace telehug {

// A serial port that telehug-passive neither holds nor gets while this object lives.
class PortClaim {
 public:
  // The error tells why not, and who holds the port if that is the reason.
  static Result<PortClaim> take(const std::string& path);
  ~PortClaim();
  PortClaim(PortClaim&& other) noexcept;
  PortClaim& operator=(PortClaim&& other) noexcept;
  PortClaim(const PortClaim&) = delete;
  PortClaim& operator=(const PortClaim&) = delete;

 private:
  explicit PortClaim(int fd) : fd_(fd) {}
  int fd_;
};

}  // namespace telehug
