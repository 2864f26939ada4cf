// SPDX-License-Identifier: Apache-2.0
//
// Where fingers end that cross the screen's bottom edge, seen in an overview of the picture.
#pragma once

#include <boost/container/static_vector.hpp>
#include <memory>

namespace telehug {

class OverviewNet {
 public:
  static constexpr int channels = 5;
  static constexpr std::size_t most_tips = 16;

  // A fingertip in cells of the overview, counted from 0.
  struct Tip {
    double column = 0;
    double row = 0;
    double logit = 0;  // log odds that there is one
  };
  using Tips = boost::container::static_vector<Tip, most_tips>;

  OverviewNet(int rows, int columns);
  OverviewNet(OverviewNet&&) noexcept;
  OverviewNet& operator=(OverviewNet&&) noexcept;
  ~OverviewNet();

  // Where to write the cells before find(): rows by columns by channels (see finger/overview.hpp).
  [[nodiscard]] float* cells() noexcept;

  // The surest first, each at least as sure as `least_logit`. Allocates nothing.
  Tips find(double least_logit);

 private:
  struct Layers;
  std::unique_ptr<Layers> layers_;
};

}  // namespace telehug
