// SPDX-License-Identifier: Apache-2.0
//
// What the nets consist of; active_side/training/nets.py is the same in Python.
#pragma once

#include <deque>
#include <initializer_list>
#include <string>

#include "net/convolution.hpp"

namespace telehug {

// A convolution and its result.
class Layer {
 public:
  Layer(const Tensors& tensors, const std::string& name, const ConvolutionShape& shape, const FeatureMap& input);
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;
  Layer(Layer&&) = delete;
  Layer& operator=(Layer&&) = delete;
  ~Layer() = default;

  void run() { convolution_.run(); }
  [[nodiscard]] const FeatureMap& result() const noexcept { return result_; }

 private:
  Convolution convolution_;
  FeatureMap result_;
};

struct SeparableShape {
  int inputs = 0;
  int outputs = 0;
  int kernel = 3;
  int stride = 1;
  bool residual = false;  // the input is added to the result
};

// A depthwise and a pointwise convolution (NAME.depthwise, NAME.pointwise).
class SeparableLayer {
 public:
  SeparableLayer(const Tensors& tensors, const std::string& name, const SeparableShape& shape, const FeatureMap& input);
  SeparableLayer(const SeparableLayer&) = delete;
  SeparableLayer& operator=(const SeparableLayer&) = delete;
  SeparableLayer(SeparableLayer&&) = delete;
  SeparableLayer& operator=(SeparableLayer&&) = delete;
  ~SeparableLayer() = default;

  void run();
  [[nodiscard]] const FeatureMap& result() const noexcept { return result_; }

 private:
  const FeatureMap& input_;
  Convolution depthwise_;
  Convolution pointwise_;
  FeatureMap between_;
  FeatureMap result_;
  bool residual_;
};

// Separable layers, one after the other: NAME.FIRST, the next one, and so on.
class SeparableStack {
 public:
  SeparableStack(const Tensors& tensors, const std::string& name, int first,
                 std::initializer_list<SeparableShape> shapes, const FeatureMap& input);

  void run();
  [[nodiscard]] const FeatureMap& result() const noexcept { return layers_.back().result(); }

 private:
  std::deque<SeparableLayer> layers_;  // which stay where they are
};

}  // namespace telehug
