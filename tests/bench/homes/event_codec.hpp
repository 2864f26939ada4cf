// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "dds/guarded_type.hpp"

namespace telehug {

// The payload that DDS sends, for the other ways: they carry the same bytes and check them in the same way.
class EventCodec {
 public:
  // Valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> encode(const TouchEvent& event);
  // Null: not a valid event. Valid until the next call.
  [[nodiscard]] const TouchEvent* decode(std::span<const std::uint8_t> bytes);

 private:
  GuardedType<TouchEvent> type_;
  Sample<TouchEvent> sample_;
  eprosima::fastrtps::rtps::SerializedPayload_t payload_{type_.m_typeSize};
  TouchEvent event_;
};

}  // namespace telehug
