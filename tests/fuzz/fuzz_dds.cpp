// SPDX-License-Identifier: Apache-2.0
//
// What a matched peer can send: any payload on any of the topics. The first byte chooses the topic; the rest goes the
// way of Reader, through the guarded decoder and from_wire.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>

#include "dds/guarded_type.hpp"
#include "dds/validate.hpp"
#include "dds/wire.hpp"

namespace telehug {
namespace {

template <typename T>
void receive(std::span<const std::uint8_t> bytes) {
  GuardedType<T> type;
  Sample<T> sample;
  // Exactly as long as the bytes, so that the address sanitizer sees a read beyond them.
  eprosima::fastrtps::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
  if (!bytes.empty()) std::memcpy(payload.data, bytes.data(), bytes.size());
  payload.length = static_cast<std::uint32_t>(bytes.size());
  if (!type.deserialize(&payload, &sample) || !sample.intact) return;
  T message;
  if (from_wire(sample.wire, message) != nullptr) return;
  if (validate(message) != nullptr) std::abort();  // what is taken is always valid
}

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> payload(data + 1, size - 1);
  switch (data[0] % 7) {
    case 0:
      telehug::receive<telehug::TouchEvent>(payload);
      break;
    case 1:
      telehug::receive<telehug::Felt>(payload);
      break;
    case 2:
      telehug::receive<telehug::Heartbeat>(payload);
      break;
    case 3:
      telehug::receive<telehug::SideStatus>(payload);
      break;
    case 4:
      telehug::receive<telehug::StopAll>(payload);
      break;
    case 5:
      telehug::receive<telehug::PairRenewal>(payload);
      break;
    default:
      telehug::receive<telehug::Hug>(payload);
      break;
  }
  return 0;
}
