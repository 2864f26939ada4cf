// SPDX-License-Identifier: Apache-2.0
//
// The file of a trained net: the line "telehug-net 1", then for each tensor a line "name size size ..." and its
// numbers, 32 bit floating point, little-endian, the last index fastest. active_side/training writes it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace telehug {

struct Tensor {
  std::vector<int> sizes;
  std::vector<float> values;
};

using Tensors = std::map<std::string, Tensor, std::less<>>;

// Throws std::runtime_error that says what is wrong if the bytes are no such file.
Tensors read_tensors(std::string_view bytes);

// Throws std::runtime_error if there is none of that name and these sizes.
const Tensor& tensor(const Tensors& tensors, std::string_view name, const std::vector<int>& sizes);

}  // namespace telehug
