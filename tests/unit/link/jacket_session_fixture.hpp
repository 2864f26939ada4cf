// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "doubles/fake_clock.hpp"
#include "link/jacket_session.hpp"

namespace telehug {

// The session with a jacket that the test plays.
class JacketSessionTest : public ::testing::Test {
 protected:
  // Everything that the session wants to write now.
  std::vector<Frame> said(bool has_backlog = false) {
    std::vector<Frame> frames;
    for (;;) {
      const EncodedFrame bytes = session.next_frame(clock.now(), has_backlog);
      if (bytes.empty()) return frames;
      for (const std::uint8_t byte : bytes) {
        if (auto frame = decoder.push(byte)) frames.push_back(*frame);
      }
      last_bytes = bytes;
    }
  }

  std::vector<protocol::FrameType> types_said(bool has_backlog = false) {
    std::vector<protocol::FrameType> types;
    for (const Frame& frame : said(has_backlog))
      types.push_back(frame.type);
    return types;
  }

  void hear(const Frame& frame) {
    const EncodedFrame bytes = encode(frame);
    session.receive({bytes.data(), bytes.size()}, clock.now());
  }
  void acknowledge(const Frame& frame) {
    hear({protocol::FrameType::ack, frame.sequence, {static_cast<std::uint8_t>(frame.type)}});
  }
  void hear_nack(protocol::NackReason reason) {
    hear({protocol::FrameType::nack, 0, {0x10, static_cast<std::uint8_t>(reason)}});
  }

  // Answers the hello; the stop before it is acknowledged.
  void answer(const std::vector<Frame>& frames, std::uint8_t version = 1, std::uint8_t motors = 16,
              std::uint8_t heaters = 0) {
    for (const Frame& frame : frames) {
      if (frame.type == protocol::FrameType::hello) {
        hear({protocol::FrameType::caps,
              frame.sequence,
              {version, 1, motors, heaters, heaters, 32, 64, 50, 25, 1, frame.payload.at(2), frame.payload.at(3)}});
      } else {
        acknowledge(frame);
      }
    }
  }

  void arm(std::uint8_t motors = 16, std::uint8_t heaters = 0) {
    session.connected(clock.now());
    answer(said(), 1, motors, heaters);
    ASSERT_TRUE(session.armed());
    clock.advance(20ms);
    ASSERT_THAT(types_said(), ::testing::ElementsAre(protocol::FrameType::status));
  }

  bool send(const MotorCommands& commands) { return session.send(commands, clock.now()); }
  bool heat(const HeaterCommands& commands) { return session.heat(commands, clock.now()); }

  FakeClock clock;
  JacketSession session;
  FrameDecoder decoder;
  EncodedFrame last_bytes;
};

}  // namespace telehug
