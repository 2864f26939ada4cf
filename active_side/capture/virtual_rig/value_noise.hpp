// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace telehug {

// A number in [0, 1) that follows from three others; changing any bit changes it altogether (SplitMix64's finaliser).
inline float hashed(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(x) * 0xBF58476D1CE4E5B9ULL +
                    static_cast<std::uint64_t>(y) * 0x94D049BB133111EBULL;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
  h ^= h >> 31;
  return static_cast<float>(h >> 40) * 0x1.0p-24F;
}

// Smooth noise in [0, 1): random values on a grid of step 1, blended in between (Perlin's "value noise").
inline float value_noise(float x, float y, std::uint64_t seed) {
  const float x0 = std::floor(x);
  const float y0 = std::floor(y);
  const auto ease = [](float t) { return t * t * (3 - 2 * t); };
  const float fx = ease(x - x0);
  const float fy = ease(y - y0);
  const auto ix = static_cast<std::int64_t>(x0);
  const auto iy = static_cast<std::int64_t>(y0);
  const float top = hashed(ix, iy, seed) * (1 - fx) + hashed(ix + 1, iy, seed) * fx;
  const float bottom = hashed(ix, iy + 1, seed) * (1 - fx) + hashed(ix + 1, iy + 1, seed) * fx;
  return top * (1 - fy) + bottom * fy;
}

// Four octaves of it, each half as strong and twice as fine; in [0, 1).
inline float fractal_noise(float x, float y, std::uint64_t seed) {
  float sum = 0;
  float weight = 8.0F / 15;
  for (std::uint64_t octave = 0; octave < 4; ++octave, weight /= 2, x *= 2, y *= 2)
    sum += weight * value_noise(x, y, seed + octave);
  return sum;
}

}  // namespace telehug
