// SPDX-License-Identifier: Apache-2.0
//
// Whatever a datagram holds that comes to a paired side: may it reach Fast DDS?
#include <cstddef>
#include <cstdint>
#include <span>

#include "dds/message_filter.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)telehug::may_pass(std::span<const std::uint8_t>(data, size));
  return 0;
}
