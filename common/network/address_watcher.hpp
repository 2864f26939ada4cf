// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

namespace telehug {

// Notices when the IPv4 addresses change by which others can reach this PC: those of interfaces that are up and have a
// carrier, without loopback. What the kernel says by rtnetlink(7) only leads to a look at all of them, so that a
// renewed lease is no change, and words that the kernel had to drop lose nothing.
class AddressWatcher {
 public:
  AddressWatcher();  // throws std::system_error
  ~AddressWatcher();
  AddressWatcher(const AddressWatcher&) = delete;
  AddressWatcher& operator=(const AddressWatcher&) = delete;

  // Readable when there may be a change.
  [[nodiscard]] int fd() const noexcept { return fd_; }

  // Are they others than at the last call (or at construction)? Does not wait.
  [[nodiscard]] bool changed();

  // As of then, "interface address" each.
  [[nodiscard]] const std::set<std::string>& addresses() const noexcept { return addresses_; }

 private:
  [[nodiscard]] bool heard_anything() const noexcept;

  int fd_ = -1;
  std::set<std::string> addresses_;
  bool look_again_ = false;
};

}  // namespace telehug
