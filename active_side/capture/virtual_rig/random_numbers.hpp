// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

namespace telehug {

// The standard library's distributions differ between implementations; these numbers don't.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1.0p-53;
  }
  bool chance(double probability) { return uniform(0, 1) < probability; }

  // 0 to count - 1.
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(uniform(0, 1) * static_cast<double>(count)); }

  template <typename T, std::size_t n>
  const T& one_of(const std::array<T, n>& choices) {
    return choices[index(n)];
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace telehug
