// SPDX-License-Identifier: Apache-2.0
//
// What is agreed with PipeWire about the pictures of a screen.
#pragma once

#include <cstdint>
#include <optional>

#include "common/units.hpp"
#include "screen_portal/frame_in_memory.hpp"

struct pw_stream;
struct spa_pod;

namespace telehug {

struct StreamFormat {
  ImageSize size;
  PixelOrder order = PixelOrder::bgrx;
};

// Asks for the pictures of `node`: any size, four bytes a pixel, in shared memory rather than in that of a graphics
// card. Returns a negative errno on failure.
int connect_to_screen(pw_stream* stream, std::uint32_t node);

// None if it is not one that was asked for.
std::optional<StreamFormat> read_format(const spa_pod* param);

// Says in which memory the pictures may come.
void accept_buffers(pw_stream* stream);

}  // namespace telehug
