// SPDX-License-Identifier: Apache-2.0
#include "net/tip_net.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "net/layers.hpp"
#include "net/weights.hpp"

namespace telehug {
namespace {

constexpr int body_channels = 48;
constexpr int whole_channels = 64;
constexpr int judge_inputs = whole_channels + body_channels + 2;
constexpr int judge_hidden = 32;
enum Output : std::uint8_t { present, touches, hover, width, spread_across, spread_along, outputs };

constexpr double width_scale = 40;  // train.py: the net tells widths in these

// A matrix and a bias.
struct Dense {
  Dense(const Tensors& tensors, const std::string& name, int inputs, int output_count)
      : weight(tensor(tensors, name + ".weight", {output_count, inputs}).values),
        bias(tensor(tensors, name + ".bias", {output_count}).values) {}

  template <std::size_t n, std::size_t m>
  void apply(const std::array<float, n>& input, std::array<float, m>& output) const {
    for (std::size_t i = 0; i < m; ++i) {
      float sum = bias[i];
      for (std::size_t k = 0; k < n; ++k)
        sum += weight[i * n + k] * input[k];
      output[i] = sum;
    }
  }

  std::vector<float> weight;
  std::vector<float> bias;
};

}  // namespace

struct TipNet::Layers {
  explicit Layers(const Tensors& tensors)
      : patch(rows, columns, 3),
        first(tensors, "first", {3, 16, 3, 2, false, true}, patch),
        body(tensors, "body", 0,
             {{16, 32, 3, 2, false},
              {32, body_channels, 5, 1, false},
              {body_channels, body_channels, 5, 1, true},
              {body_channels, body_channels, 5, 1, true}},
             first.result()),
        heat_hidden(tensors, "heat_hidden", {body_channels, 32, 1, 1, false, true}, body.result()),
        heat(tensors, "heat", {32, 4, 1, 1, false, false}, heat_hidden.result()),
        whole(tensors, "whole", 0,
              {{body_channels, whole_channels, 3, 2, false}, {whole_channels, whole_channels, 5, 1, true}},
              body.result()),
        hidden(tensors, "judge_hidden", judge_inputs, judge_hidden),
        judge(tensors, "judge", judge_hidden, outputs),
        share(heat.result().size()) {}

  void run() {
    first.run();
    body.run();
    heat_hidden.run();
    heat.run();
    whole.run();
  }

  FeatureMap patch;
  Layer first;
  SeparableStack body;
  Layer heat_hidden;
  Layer heat;
  SeparableStack whole;
  Dense hidden;
  Dense judge;
  std::vector<float> share;  // of the heat, four values for each place of the body's map
};

TipNet::TipNet() : layers_(std::make_unique<Layers>(read_tensors(tip_weights()))) {}
TipNet::TipNet(TipNet&&) noexcept = default;
TipNet& TipNet::operator=(TipNet&&) noexcept = default;
TipNet::~TipNet() = default;

float* TipNet::patch() noexcept {
  return layers_->patch.values.data();
}

TipLook TipNet::look(double u, double v) {
  Layers& layers = *layers_;
  layers.run();
  const FeatureMap& heat = layers.heat.result();
  const auto heat_end = heat.values.begin() + static_cast<std::ptrdiff_t>(heat.size());
  const float largest = *std::max_element(heat.values.begin(), heat_end);
  float sum = 0;
  for (std::size_t i = 0; i < layers.share.size(); ++i)
    sum += layers.share[i] = std::exp(heat.values[i] - largest);
  const float scale = 1 / sum;

  // The mean place (Sun et al.: Integral Human Pose Regression, 2018), and the body's features there.
  std::array<float, judge_inputs> features{};
  const FeatureMap& body = layers.body.result();
  double column = 0;
  double row = 0;
  const std::size_t places = heat.size() / 4;
  for (std::size_t i = 0; i < places; ++i) {
    const float* const four = layers.share.data() + 4 * i;
    const float here = (four[0] + four[1] + four[2] + four[3]) * scale;
    if (here < 1e-6F) continue;
    const std::size_t down = i / static_cast<std::size_t>(heat.columns);
    const std::size_t across = i % static_cast<std::size_t>(heat.columns);
    column += here * (4 * static_cast<double>(across) + 0.5) + 2.0 * scale * (four[1] + four[3]);
    row += here * (4 * static_cast<double>(down) + 0.5) + 2.0 * scale * (four[2] + four[3]);
    const float* const at = body.values.data() + i * body_channels;
    for (std::size_t k = 0; k < body_channels; ++k)
      features[whole_channels + k] += here * at[k];
  }
  const FeatureMap& whole = layers.whole.result();
  const auto count = static_cast<std::size_t>(whole.rows) * static_cast<std::size_t>(whole.columns);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < whole_channels; ++k)
      features[k] += whole.values[i * whole_channels + k];
  }
  for (std::size_t k = 0; k < whole_channels; ++k)
    features[k] /= static_cast<float>(count);
  features[judge_inputs - 2] = static_cast<float>(u);
  features[judge_inputs - 1] = static_cast<float>(v);

  std::array<float, judge_hidden> hidden{};
  layers.hidden.apply(features, hidden);
  for (float& value : hidden)
    value = std::max(value, 0.0F);
  std::array<float, outputs> judged{};
  layers.judge.apply(hidden, judged);
  return {column,
          row,
          judged[present],
          judged[touches],
          std::max(0.0, std::expm1(static_cast<double>(judged[hover]))),
          std::max(0.0, width_scale * static_cast<double>(judged[width])),
          std::exp(static_cast<double>(judged[spread_across])),
          std::exp(static_cast<double>(judged[spread_along]))};
}

}  // namespace telehug
