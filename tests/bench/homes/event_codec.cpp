// SPDX-License-Identifier: Apache-2.0
#include "bench/homes/event_codec.hpp"

#include <cstring>
#include <stdexcept>

#include "dds/wire.hpp"

namespace telehug {

std::span<const std::uint8_t> EventCodec::encode(const TouchEvent& event) {
  to_wire(event, sample_.wire);
  if (!type_.serialize(&sample_, &payload_)) throw std::runtime_error("a TouchEvent can't be encoded");
  return {payload_.data, payload_.length};
}

const TouchEvent* EventCodec::decode(std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || bytes.size() > payload_.max_size) return nullptr;
  std::memcpy(payload_.data, bytes.data(), bytes.size());
  payload_.length = static_cast<std::uint32_t>(bytes.size());
  if (!type_.deserialize(&payload_, &sample_) || !sample_.intact) return nullptr;
  return from_wire(sample_.wire, event_) == nullptr ? &event_ : nullptr;
}

}  // namespace telehug
