// SPDX-License-Identifier: Apache-2.0
#include "net/tensors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace telehug {
namespace {

constexpr std::string_view first_line = "telehug-net 1";
constexpr std::size_t most_values = 10'000'000;

// Up to the next line feed, which is taken away with it.
std::string_view take_line(std::string_view& bytes) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) throw std::runtime_error("trained net: the file ends within a line");
  const std::string_view line = bytes.substr(0, end);
  bytes.remove_prefix(end + 1);
  return line;
}

float take_float(std::string_view& bytes) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < sizeof bits; ++i)
    bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  bytes.remove_prefix(sizeof bits);
  return std::bit_cast<float>(bits);
}

}  // namespace

Tensors read_tensors(std::string_view bytes) {
  if (take_line(bytes) != first_line) throw std::runtime_error("trained net: not a file of this version");
  Tensors tensors;
  while (!bytes.empty()) {
    std::istringstream words{std::string(take_line(bytes))};
    std::string name;
    words >> name;
    Tensor read;
    std::size_t count = 1;
    for (int size = 0; words >> size;) {
      if (size <= 0 || count > most_values / static_cast<std::size_t>(size)) {
        throw std::runtime_error(fmt::format("trained net: {} has an impossible size", name));
      }
      count *= static_cast<std::size_t>(size);
      read.sizes.push_back(size);
    }
    if (name.empty() || read.sizes.empty() || !words.eof()) {
      throw std::runtime_error("trained net: a tensor without name or size");
    }
    if (bytes.size() < count * sizeof(float)) {
      throw std::runtime_error(fmt::format("trained net: the file ends within {}", name));
    }
    read.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
      read.values.push_back(take_float(bytes));
    tensors.emplace(std::move(name), std::move(read));
  }
  return tensors;
}

const Tensor& tensor(const Tensors& tensors, std::string_view name, const std::vector<int>& sizes) {
  const auto found = tensors.find(name);
  if (found == tensors.end()) throw std::runtime_error(fmt::format("trained net: there is no {}", name));
  if (found->second.sizes != sizes) {
    throw std::runtime_error(fmt::format("trained net: {} is of {} values, but {} are wanted", name,
                                         fmt::join(found->second.sizes, " by "), fmt::join(sizes, " by ")));
  }
  return found->second;
}

}  // namespace telehug
