// SPDX-License-Identifier: Apache-2.0
#include "net/overview_net.hpp"

#include <algorithm>

#include "net/layers.hpp"
#include "net/weights.hpp"

namespace telehug {

struct OverviewNet::Layers {
  Layers(const Tensors& tensors, int rows, int columns)
      : cells(rows, columns, channels),
        first(tensors, "first", {channels, 12, 3, 2, false, true}, cells),
        body(tensors, "body", 0,
             {{12, 32, 3, 2, false},
              {32, 32, 5, 1, true},
              {32, 32, 5, 1, true},
              {32, 32, 5, 1, true},
              {32, 32, 5, 1, true}},
             first.result()),
        hidden(tensors, "hidden", {32, 32, 1, 1, false, true}, body.result()),
        logits(tensors, "logits", {32, 4, 1, 1, false, false}, hidden.result()) {}

  void run() {
    first.run();
    body.run();
    hidden.run();
    logits.run();
  }

  // Four values at each place are those of two rows and two columns.
  [[nodiscard]] float logit(int row, int column) const {
    const FeatureMap& map = logits.result();
    const auto place = static_cast<std::size_t>(row / 2) * static_cast<std::size_t>(map.columns) +
                       static_cast<std::size_t>(column / 2);
    return map.values[4 * place + static_cast<std::size_t>(row % 2 * 2) + static_cast<std::size_t>(column % 2)];
  }
  [[nodiscard]] bool is_peak(int row, int column, float value) const {
    for (int r = std::max(0, row - 1); r <= std::min(row + 1, 2 * logits.result().rows - 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(column + 1, 2 * logits.result().columns - 1); ++c) {
        const bool before = r < row || (r == row && c < column);
        if (before ? logit(r, c) >= value : logit(r, c) > value) return false;
      }
    }
    return true;
  }

  // The peak's place between the grid's: of the parabola through it and its neighbours.
  [[nodiscard]] static double vertex(int at, int last, double before, double here, double after) {
    const double bend = before - 2 * here + after;
    if (at == 0 || at == last || bend > -1e-3) return at;
    return at + std::clamp(0.5 * (before - after) / bend, -0.5, 0.5);
  }
  [[nodiscard]] double vertex_row(int row, int column) const {
    const int last = 2 * logits.result().rows - 1;
    return vertex(row, last, logit(std::max(row - 1, 0), column), logit(row, column),
                  logit(std::min(row + 1, last), column));
  }
  [[nodiscard]] double vertex_column(int row, int column) const {
    const int last = 2 * logits.result().columns - 1;
    return vertex(column, last, logit(row, std::max(column - 1, 0)), logit(row, column),
                  logit(row, std::min(column + 1, last)));
  }

  FeatureMap cells;
  Layer first;
  SeparableStack body;
  Layer hidden;
  Layer logits;
};

OverviewNet::OverviewNet(int rows, int columns)
    : layers_(std::make_unique<Layers>(read_tensors(overview_weights()), rows, columns)) {}
OverviewNet::OverviewNet(OverviewNet&&) noexcept = default;
OverviewNet& OverviewNet::operator=(OverviewNet&&) noexcept = default;
OverviewNet::~OverviewNet() = default;

float* OverviewNet::cells() noexcept {
  return layers_->cells.values.data();
}

OverviewNet::Tips OverviewNet::find(double least_logit) {
  Layers& layers = *layers_;
  layers.run();
  Tips tips;
  const FeatureMap& map = layers.logits.result();
  const std::size_t count = map.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (map.values[i] < least_logit) continue;
    const int place = static_cast<int>(i / 4);
    const int row = place / map.columns * 2 + static_cast<int>(i % 4 / 2);
    const int column = place % map.columns * 2 + static_cast<int>(i % 2);
    if (!layers.is_peak(row, column, map.values[i])) continue;
    const Tip tip{2 * layers.vertex_column(row, column) + 0.5, 2 * layers.vertex_row(row, column) + 0.5, map.values[i]};
    if (tips.size() == most_tips) {
      if (tips.back().logit >= tip.logit) continue;
      tips.pop_back();
    }
    const auto place_in_order =
        std::find_if(tips.begin(), tips.end(), [&](const Tip& other) { return other.logit < tip.logit; });
    tips.insert(place_in_order, tip);
  }
  return tips;
}

}  // namespace telehug
