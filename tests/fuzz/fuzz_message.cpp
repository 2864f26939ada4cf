// SPDX-License-Identifier: Apache-2.0
//
// Whatever a datagram holds that comes to a paired side: what may reach Fast DDS, and what it says of whom.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "dds/message_filter.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> message(data, size);
  if (!telehug::may_pass(message)) return 0;
  telehug::Announcements announcements;
  const bool first = announcements.are_as_before(message);
  // Said a second time it is the same, unless it contradicts itself.
  if (first && !announcements.are_as_before(message)) std::abort();
  return 0;
}
