// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <vector>

#include "link/frame_codec.hpp"
#include "simulator/simulated_jacket.hpp"

namespace telehug {

// The real firmware in virtual time, spoken to frame by frame.
class VirtualJacket {
 public:
  explicit VirtualJacket(const BoardWiring& board = board_wirings().front())
      : chip(std::filesystem::path(TELEHUG_FIRMWARE_FOLDER) / board.elf, board) {
    chip.on_edge([this](const PinEdge& edge) { edges.push_back(edge); });
    chip.run_ms(5);
  }

  // Sends bytes and runs until the last of them has arrived; returns the cycle at which it did.
  std::uint64_t say_bytes(std::span<const std::uint8_t> bytes) {
    chip.write(bytes);
    while (chip.bytes_in_flight() != 0)
      chip.run_cycles(jacket_cycles_per_ms / 20);
    return chip.cycle();
  }

  std::uint64_t say(const Frame& frame) {
    const EncodedFrame encoded = encode(frame);
    return say_bytes({encoded.data(), encoded.size()});
  }
  std::uint64_t say(protocol::FrameType type, const FramePayload& payload = {}) {
    return say({type, ++sequence, payload});
  }

  // Sends a frame and returns its answer, if one comes within 20 ms.
  std::optional<Frame> ask(const Frame& frame) {
    (void)hear(0);
    say(frame);
    const auto answers = hear(20);
    return answers.empty() ? std::nullopt : std::optional(answers.front());
  }
  std::optional<Frame> ask(protocol::FrameType type, const FramePayload& payload = {}) {
    return ask(Frame{type, ++sequence, payload});
  }

  // Runs for a while and returns the frames that came.
  std::vector<Frame> hear(std::uint64_t ms) {
    chip.run_ms(ms);
    std::vector<Frame> frames;
    for (const std::uint8_t byte : chip.take_output()) {
      if (auto frame = decoder.push(byte)) frames.push_back(*frame);
    }
    return frames;
  }

  std::optional<Frame> hello() { return ask(protocol::FrameType::hello, {1, 1, 0x34, 0x12}); }

  protocol::Telemetry telemetry() {
    const auto answer = ask(protocol::FrameType::status);
    return answer ? parse_telemetry(*answer).value() : protocol::Telemetry{};
  }

  // Runs while saying "keep" every 100 ms.
  void run_kept_alive_ms(std::uint64_t ms) {
    for (std::uint64_t passed = 0; passed < ms; passed += 100) {
      say(protocol::FrameType::keep);
      chip.run_ms(std::min<std::uint64_t>(ms - passed, 100));
    }
  }

  [[nodiscard]] std::set<int> channels_that_rose_since(std::uint64_t cycle) const {
    std::set<int> channels;
    for (const PinEdge& edge : edges) {
      if (edge.high && edge.cycle >= cycle) channels.insert(edge.channel);
    }
    return channels;
  }

  // The cycle at which the channel was high for the last time.
  [[nodiscard]] std::uint64_t last_high(std::uint8_t channel) const {
    if (chip.is_high(channel)) return chip.cycle();
    std::uint64_t cycle = 0;
    for (const PinEdge& edge : edges) {
      if (edge.channel == channel && !edge.high) cycle = edge.cycle;
    }
    return cycle;
  }

  // Share of the time from `from` to now in which the channel was high.
  [[nodiscard]] double duty_since(std::uint64_t from, std::uint8_t channel) const {
    std::uint64_t high_cycles = 0;
    bool high = false;
    std::uint64_t since = from;
    for (const PinEdge& edge : edges) {
      if (edge.channel != channel) continue;
      if (high && edge.cycle > from) high_cycles += edge.cycle - since;
      high = edge.high;
      since = std::max(edge.cycle, from);
    }
    if (high) high_cycles += chip.cycle() - since;
    return static_cast<double>(high_cycles) / static_cast<double>(chip.cycle() - from);
  }

  [[nodiscard]] bool anything_high() const {
    for (std::uint8_t channel = 0; channel < jacket_outputs; ++channel) {
      if (chip.is_high(channel)) return true;
    }
    return false;
  }

  SimulatedJacket chip;
  std::vector<PinEdge> edges;
  FrameDecoder decoder;
  std::uint8_t sequence = 0;
};

inline double to_ms(std::uint64_t cycles) {
  return static_cast<double>(cycles) / jacket_cycles_per_ms;
}

}  // namespace telehug
