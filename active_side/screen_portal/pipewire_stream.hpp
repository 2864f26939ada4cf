// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "screen_portal/frame_slot.hpp"

namespace telehug {

// Receives the pictures of one node of PipeWire into a slot. Of pictures that stay the same none comes. For one thread,
// which waits until fd() can be read and then calls process().
class PipeWireStream {
 public:
  enum class State {
    waiting,  // for what shows the screen to start, or to go on
    flowing,  // the newest frame is what the screen shows
    failed,   // for good; failure() says why
  };

  // `pipewire_fd` is a connection to PipeWire and becomes the stream's. `slot` outlives the stream.
  PipeWireStream(int pipewire_fd, std::uint32_t node, FrameSlot& slot);
  ~PipeWireStream();
  PipeWireStream(const PipeWireStream&) = delete;
  PipeWireStream& operator=(const PipeWireStream&) = delete;

  [[nodiscard]] int fd() const;  // -1 after a failure
  void process();

  [[nodiscard]] State state() const;
  [[nodiscard]] const std::string& failure() const;  // a sentence

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace telehug
