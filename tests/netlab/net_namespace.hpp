// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace telehug {

// A network of its own, without a name: it goes away with this object and with the last program in it, however they
// end.
class NetNamespace {
 public:
  // Throws std::system_error where that is not permitted.
  NetNamespace();
  ~NetNamespace();
  NetNamespace(const NetNamespace&) = delete;
  NetNamespace& operator=(const NetNamespace&) = delete;

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

 private:
  int descriptor_ = -1;
};

// While it lives, what this thread starts and opens belongs to that network.
class InsideNamespace {
 public:
  explicit InsideNamespace(const NetNamespace& network);
  ~InsideNamespace();
  InsideNamespace(const InsideNamespace&) = delete;
  InsideNamespace& operator=(const InsideNamespace&) = delete;

 private:
  int before_ = -1;
};

}  // namespace telehug
