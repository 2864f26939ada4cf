// SPDX-License-Identifier: Apache-2.0
//
// What comes over the jacket's wire: any bytes, beginning anywhere.
#include <cstdint>
#include <cstdlib>

#include "link/frame_codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  telehug::FrameDecoder decoder;
  for (std::size_t i = 0; i < size; ++i) {
    const auto frame = decoder.push(data[i]);
    if (!frame) continue;
    (void)telehug::parse_caps(*frame);
    (void)telehug::parse_telemetry(*frame);
    // What was taken is the same frame when it is sent again.
    telehug::FrameDecoder again;
    std::optional<telehug::Frame> repeated;
    for (const std::uint8_t byte : telehug::encode(*frame))
      repeated = again.push(byte);
    if (!repeated || repeated->type != frame->type || repeated->sequence != frame->sequence ||
        repeated->payload != frame->payload)
      std::abort();
  }
  return 0;
}
