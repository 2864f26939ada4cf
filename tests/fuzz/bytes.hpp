// SPDX-License-Identifier: Apache-2.0
//
// Decisions taken from a fuzzer's input. What is beyond its end is zero, so that every input is a whole story.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace telehug {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

  [[nodiscard]] bool empty() const { return left_.empty(); }

  std::uint8_t byte() {
    if (left_.empty()) return 0;
    const std::uint8_t first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }

  // As many bytes as `Number` has, the lowest first.
  template <typename Number>
  Number number() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i)
      value |= static_cast<std::uint64_t>(byte()) << (8 * i);
    return static_cast<Number>(value);
  }

  // Below `end`, which is above 0.
  std::size_t below(std::size_t end) { return number<std::uint16_t>() % end; }

  std::string text(std::size_t size) {
    std::string taken;
    while (taken.size() < size && !left_.empty())
      taken += static_cast<char>(byte());
    return taken;
  }

  std::string rest() { return text(left_.size()); }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace telehug
