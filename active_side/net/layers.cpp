// SPDX-License-Identifier: Apache-2.0
#include "net/layers.hpp"

namespace telehug {

Layer::Layer(const Tensors& tensors, const std::string& name, const ConvolutionShape& shape, const FeatureMap& input)
    : convolution_(tensors, name, shape), result_(convolution_.result_of(input)) {
  convolution_.connect(input, result_);
}

SeparableLayer::SeparableLayer(const Tensors& tensors, const std::string& name, const SeparableShape& shape,
                               const FeatureMap& input)
    : input_(input),
      depthwise_(tensors, name + ".depthwise", {shape.inputs, shape.inputs, shape.kernel, shape.stride, true, true}),
      pointwise_(tensors, name + ".pointwise", {shape.inputs, shape.outputs, 1, 1, false, true}),
      between_(depthwise_.result_of(input)),
      result_(pointwise_.result_of(between_)),
      residual_(shape.residual) {
  depthwise_.connect(input_, between_);
  pointwise_.connect(between_, result_);
}

void SeparableLayer::run() {
  depthwise_.run();
  pointwise_.run();
  if (!residual_) return;
  float* const sum = result_.values.data();
  const float* const input = input_.values.data();
  const std::size_t count = result_.size();
  for (std::size_t i = 0; i < count; ++i)
    sum[i] += input[i];
}

SeparableStack::SeparableStack(const Tensors& tensors, const std::string& name, int first,
                               std::initializer_list<SeparableShape> shapes, const FeatureMap& input) {
  for (const SeparableShape& shape : shapes) {
    const FeatureMap& before = layers_.empty() ? input : layers_.back().result();
    layers_.emplace_back(tensors, name + "." + std::to_string(first++), shape, before);
  }
}

void SeparableStack::run() {
  for (SeparableLayer& layer : layers_)
    layer.run();
}

}  // namespace telehug
