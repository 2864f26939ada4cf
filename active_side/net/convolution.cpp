// SPDX-License-Identifier: Apache-2.0
#include "net/convolution.hpp"

#include <xnnpack.h>

#include <limits>
#include <stdexcept>

namespace telehug {
namespace {

void expect(xnn_status status, const char* what) {
  if (status != xnn_status_success) throw std::runtime_error(std::string("XNNPACK can't ") + what);
}

std::size_t unsigned_of(int value) {
  return static_cast<std::size_t>(value);
}

}  // namespace

FeatureMap::FeatureMap(int row_count, int column_count, int channel_count)
    : rows(row_count),
      columns(column_count),
      channels(channel_count),
      values(size() + XNN_EXTRA_BYTES / sizeof(float), 0.0F) {}

Convolution::Convolution(const Tensors& tensors, const std::string& name, const ConvolutionShape& shape)
    : shape_(shape) {
  expect(xnn_initialize(nullptr), "start");
  const int group_inputs = shape.depthwise ? 1 : shape.inputs;
  const Tensor& weight = tensor(tensors, name + ".weight", {shape.outputs, shape.kernel, shape.kernel, group_inputs});
  const Tensor& bias = tensor(tensors, name + ".bias", {shape.outputs});
  const auto kernel = static_cast<std::uint32_t>(shape.kernel);
  const auto stride = static_cast<std::uint32_t>(shape.stride);
  const std::uint32_t pad = kernel / 2;
  const std::size_t inputs = unsigned_of(shape.inputs);
  const std::size_t outputs = unsigned_of(shape.outputs);
  const std::uint32_t groups = shape.depthwise ? static_cast<std::uint32_t>(shape.inputs) : 1;
  constexpr float infinite = std::numeric_limits<float>::infinity();
  xnn_operator_t created = nullptr;
  expect(xnn_create_convolution2d_nhwc_f32(pad, pad, pad, pad, kernel, kernel, stride, stride, 1, 1, groups,
                                           unsigned_of(group_inputs), outputs / groups, inputs, outputs,
                                           weight.values.data(), bias.values.data(), shape.rectified ? 0 : -infinite,
                                           infinite, 0, &created),
         "make a convolution");
  operator_.reset(created);
}

void Convolution::Destroy::operator()(xnn_operator* op) const noexcept {
  xnn_delete_operator(op);
}

FeatureMap Convolution::result_of(const FeatureMap& input) const {
  return {(input.rows + shape_.stride - 1) / shape_.stride, (input.columns + shape_.stride - 1) / shape_.stride,
          shape_.outputs};
}

void Convolution::connect(const FeatureMap& input, FeatureMap& output) {
  const int stride = shape_.stride;
  if (input.channels != shape_.inputs || output.channels != shape_.outputs ||
      output.rows != (input.rows + stride - 1) / stride || output.columns != (input.columns + stride - 1) / stride) {
    throw std::runtime_error("trained net: maps do not fit the convolution between them");
  }
  expect(xnn_setup_convolution2d_nhwc_f32(operator_.get(), 1, unsigned_of(input.rows), unsigned_of(input.columns),
                                          input.values.data(), output.values.data(), nullptr),
         "set a convolution up");
}

void Convolution::run() {
  expect(xnn_run_operator(operator_.get(), nullptr), "run a convolution");
}

}  // namespace telehug
