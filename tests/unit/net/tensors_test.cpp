// SPDX-License-Identifier: Apache-2.0
#include "net/tensors.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "net/weights.hpp"

namespace telehug {
namespace {

using namespace std::string_literals;

const std::string small = "telehug-net 1\na 2 1\n\0\0\x80?\0\0\0\xC0"s + "b 1\n\0\0\0?"s;

TEST(Tensors, AreReadWithTheirSizes) {
  const Tensors read = read_tensors(small);
  EXPECT_EQ(tensor(read, "a", {2, 1}).values, (std::vector<float>{1, -2}));
  EXPECT_EQ(tensor(read, "b", {1}).values, (std::vector<float>{0.5}));
}

TEST(Tensors, OfOtherNamesOrSizesAreRefused) {
  const Tensors read = read_tensors(small);
  EXPECT_THROW((void)tensor(read, "c", {1}), std::runtime_error);
  EXPECT_THROW((void)tensor(read, "a", {1, 2}), std::runtime_error);
}

TEST(Tensors, OfADamagedFileAreRefused) {
  for (std::size_t length = 0; length < small.size(); ++length) {
    const std::string cut = small.substr(0, length);
    if (cut == "telehug-net 1\n" || cut == small.substr(0, small.find("b 1"))) continue;  // whole, with less in it
    EXPECT_THROW((void)read_tensors(cut), std::runtime_error) << length;
  }
  EXPECT_THROW((void)read_tensors("telehug-net 2\n"), std::runtime_error);
  EXPECT_THROW((void)read_tensors("telehug-net 1\na 0\n"), std::runtime_error);
  EXPECT_THROW((void)read_tensors("telehug-net 1\na -1\n"), std::runtime_error);
  EXPECT_THROW((void)read_tensors("telehug-net 1\na 100000 100000\n"), std::runtime_error);
  EXPECT_THROW((void)read_tensors("telehug-net 1\na x\n"), std::runtime_error);
  EXPECT_THROW((void)read_tensors("telehug-net 1\n\n"), std::runtime_error);
}

TEST(Tensors, OfBothNetsArePartOfTheProgram) {
  EXPECT_GT(read_tensors(overview_weights()).size(), 10U);
  EXPECT_GT(read_tensors(tip_weights()).size(), 10U);
}

}  // namespace
}  // namespace telehug
