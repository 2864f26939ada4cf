// SPDX-License-Identifier: Apache-2.0
//
// Convolutions of maps, by XNNPACK, on the caller's thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "net/tensors.hpp"

struct xnn_operator;

namespace telehug {

// Values of some channels at each place of a grid, row by row, channels together.
struct FeatureMap {
  FeatureMap() = default;
  FeatureMap(int row_count, int column_count, int channel_count);

  [[nodiscard]] std::size_t size() const noexcept {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) * static_cast<std::size_t>(channels);
  }

  int rows = 0;
  int columns = 0;
  int channels = 0;
  std::vector<float> values;  // a few more than size(): XNNPACK reads beyond the end
};

struct ConvolutionShape {
  int inputs = 0;
  int outputs = 0;
  int kernel = 1;  // rows and columns of the kernel, odd
  int stride = 1;
  bool depthwise = false;  // each channel by itself; outputs == inputs
  bool rectified = true;   // below 0 becomes 0
};

// Beyond its edges a map is 0; with stride 1 the result is as large as the input, with 2 half as large (rounded up).
class Convolution {
 public:
  // Its tensors are NAME.weight (outputs, rows, columns, inputs; depthwise: 1 input) and NAME.bias. Throws
  // std::runtime_error if they are not there or of other sizes.
  Convolution(const Tensors& tensors, const std::string& name, const ConvolutionShape& shape);

  // How large the result for this input is.
  [[nodiscard]] FeatureMap result_of(const FeatureMap& input) const;

  // From now on run() reads `input` and writes `output`, which must stay where they are. Throws std::runtime_error if
  // their sizes don't fit.
  void connect(const FeatureMap& input, FeatureMap& output);

  // Allocates nothing.
  void run();

 private:
  struct Destroy {
    void operator()(xnn_operator* op) const noexcept;
  };
  ConvolutionShape shape_;
  std::unique_ptr<xnn_operator, Destroy> operator_;
};

}  // namespace telehug
