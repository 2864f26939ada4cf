// SPDX-License-Identifier: Apache-2.0
//
// The nets compute here what they computed where they were trained (active_side/training/golden.py).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "doubles/allocation_counter.hpp"
#include "net/convolution.hpp"
#include "net/overview_net.hpp"
#include "net/tip_net.hpp"

namespace telehug {
namespace {

std::vector<double> numbers_of(const std::string& name) {
  std::ifstream file(std::string(TELEHUG_FIXTURES "/net/") + name);
  std::vector<double> numbers;
  for (double number = 0; file >> number;)
    numbers.push_back(number);
  return numbers;
}

// The same pictures as golden.py makes: a wave for each value.
float wave(std::size_t i) {
  return static_cast<float>(std::sin(0.37 * static_cast<double>(i)) * std::cos(0.0021 * static_cast<double>(i)));
}

TEST(TipNet, SeesWhatItSawWhereItWasTrained) {
  const std::vector<double> wanted = numbers_of("tip.txt");
  ASSERT_EQ(wanted.size(), 8U);
  TipNet net;
  for (std::size_t i = 0; i < TipNet::rows * TipNet::columns * 3; ++i)
    net.patch()[i] = wave(i);
  const TipLook look = net.look(0.25, -0.5);
  EXPECT_NEAR(look.column, wanted[0], 0.01);
  EXPECT_NEAR(look.row, wanted[1], 0.01);
  EXPECT_NEAR(look.present_logit, wanted[2], 0.01);
  EXPECT_NEAR(look.touches_logit, wanted[3], 0.01);
  EXPECT_NEAR(look.hover_mm, wanted[4], 0.01);
  EXPECT_NEAR(look.width, wanted[5], 0.05);
  EXPECT_NEAR(look.spread_columns, wanted[6], 0.01);
  EXPECT_NEAR(look.spread_rows, wanted[7], 0.01);
}

TEST(OverviewNet, SeesWhatItSawWhereItWasTrained) {
  const std::vector<double> wanted = numbers_of("overview.txt");  // the surest place: column, row, logit
  ASSERT_EQ(wanted.size(), 3U);
  constexpr int rows = 53;  // odd, and so is their half
  constexpr int columns = 101;
  OverviewNet net(rows, columns);
  for (std::size_t i = 0; i < rows * columns * OverviewNet::channels; ++i)
    net.cells()[i] = wave(i);
  const auto tips = net.find(-100);
  ASSERT_FALSE(tips.empty());
  EXPECT_EQ(tips.size(), OverviewNet::most_tips);
  EXPECT_NEAR(tips[0].column, wanted[0], 1) << "between its neighbours";
  EXPECT_NEAR(tips[0].row, wanted[1], 1);
  EXPECT_NEAR(tips[0].logit, wanted[2], 0.01);
  for (std::size_t i = 1; i < tips.size(); ++i)
    EXPECT_LE(tips[i].logit, tips[i - 1].logit);
  const auto sure = net.find(tips[3].logit);
  EXPECT_EQ(sure.size(), 4U);
}

TEST(Nets, AllocateNothingWhenTheyLook) {
  TipNet tip;
  OverviewNet overview(40, 120);
  (void)tip.look(0, 0);
  (void)overview.find(0);
  const auto before = allocation_count();
  (void)tip.look(0, 0);
  (void)overview.find(0);
  EXPECT_EQ(allocation_count(), before);
}

TEST(Nets, SurviveEveryNumber) {
  TipNet net;
  std::fill_n(net.patch(), TipNet::rows * TipNet::columns * 3, std::numeric_limits<float>::quiet_NaN());
  (void)net.look(0, 0);
  std::fill_n(net.patch(), TipNet::rows * TipNet::columns * 3, 1e6F);
  (void)net.look(1e6, -1e6);
}

TEST(Convolution, IsZeroBeyondTheEdges) {
  Tensors tensors;
  tensors["c.weight"] = {{1, 3, 3, 1}, std::vector<float>(9, 1)};
  tensors["c.bias"] = {{1}, {0}};
  FeatureMap input(3, 4, 1);
  std::fill_n(input.values.begin(), 12, 1.0F);
  Convolution convolution(tensors, "c", {1, 1, 3, 1, false, true});
  FeatureMap output = convolution.result_of(input);
  convolution.connect(input, output);
  convolution.run();
  const std::vector<float> wanted{4, 6, 6, 4, 6, 9, 9, 6, 4, 6, 6, 4};
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_EQ(output.values[i], wanted[i]) << i;
}

TEST(Convolution, RefusesMapsThatDoNotFit) {
  Tensors tensors;
  tensors["c.weight"] = {{2, 1, 1, 3}, std::vector<float>(6, 1)};
  tensors["c.bias"] = {{2}, {0, 0}};
  Convolution convolution(tensors, "c", {3, 2, 1, 1, false, true});
  const FeatureMap input(4, 4, 3);
  FeatureMap narrow(4, 3, 2);
  EXPECT_THROW(convolution.connect(input, narrow), std::runtime_error);
  const FeatureMap flat(4, 4, 1);
  FeatureMap output(4, 4, 2);
  EXPECT_THROW(convolution.connect(flat, output), std::runtime_error);
}

}  // namespace
}  // namespace telehug
