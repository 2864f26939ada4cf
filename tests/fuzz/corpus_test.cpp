// SPDX-License-Identifier: Apache-2.0
//
// Gives a fuzzer's kept inputs to it once more, in every build and without clang.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

TEST(TheFuzzersCorpus, DoesNoHarm) {
  int inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TELEHUG_CORPUS)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0) << entry.path();
    ++inputs;
  }
  EXPECT_GT(inputs, 0) << "no inputs in " TELEHUG_CORPUS;
}

}  // namespace
