// SPDX-License-Identifier: Apache-2.0
//
// The microcontroller's own end of the wire, session.cpp built for the host: any bytes and any frames. It asks of its
// motors and heaters only what they can do (firmware_board.cpp), all that it answers are frames of the protocol, and it
// takes and refuses the same frames as the host's decoder.
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "doubles/firmware_board.hpp"
#include "fuzz/bytes.hpp"
#include "link/frame_codec.hpp"
#include "session.hpp"

namespace telehug {
namespace {

using protocol::FrameType;

void require(bool holds) {
  if (!holds) std::abort();
}

class FuzzedWire {
 public:
  FuzzedWire() {
    firmware_board::reset();
    send(std::vector<std::uint8_t>{0});  // ends what the input before has left
    const ReceivedTelemetry told = ask();
    frames_unseen_ = told.frames_ok - frames_;
    malformed_unseen_ = told.frames_malformed - decoder_.malformed();
  }

  void step(Bytes& bytes) {
    switch (bytes.byte() % 8) {
      case 0:
        send_text(bytes.text(bytes.byte()));
        break;
      case 1:
        send(std::vector<std::uint8_t>{0});
        break;
      case 2:
        firmware_board::disarm();
        break;
      case 3:
        firmware_board::set_room(bytes.byte());
        break;
      case 4:
        send_frame(FrameType::hello, {1, 1, bytes.byte(), bytes.byte()});
        break;
      default:
        fuzzed_frame(bytes);
    }
    check_answers();
  }

  // Both ends have counted the same.
  void check_counts() {
    firmware_board::set_room(255);
    send(std::vector<std::uint8_t>{0});
    check_answers();
    const ReceivedTelemetry told = ask();
    require(told.frames_ok == static_cast<std::uint16_t>(frames_ + frames_unseen_));
    require(told.frames_malformed == static_cast<std::uint16_t>(decoder_.malformed() + malformed_unseen_));
  }

 private:
  void send(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
      session::receive(byte);
      if (decoder_.push(byte)) ++frames_;
    }
  }
  void send_text(const std::string& text) { send(std::vector<std::uint8_t>(text.begin(), text.end())); }
  void send_frame(FrameType type, const FramePayload& payload) {
    const EncodedFrame encoded = encode({type, ++sequence_, payload});
    send({encoded.data(), encoded.size()});
  }
  // Often one that is valid but for its values; sometimes a repetition; sometimes with a byte changed.
  void fuzzed_frame(Bytes& bytes) {
    static constexpr FrameType types[]{FrameType::hello,   FrameType::keep,   FrameType::stop_all, FrameType::set,
                                       FrameType::set_all, FrameType::status, FrameType::heat,     FrameType{0x7F}};
    const FrameType type = types[bytes.byte() % 8];
    const std::uint8_t change = bytes.byte();
    const std::string payload = bytes.text(bytes.byte() % (protocol::payload_max_bytes + 1));
    if (change % 8 == 0) --sequence_;
    EncodedFrame encoded = encode({type, ++sequence_, FramePayload(payload.begin(), payload.end())});
    if (change % 8 == 1) encoded.at(change % encoded.size()) ^= bytes.byte();
    send({encoded.data(), encoded.size()});
  }
  void check_answers() {
    FrameDecoder answers;
    for (const std::uint8_t byte : firmware_board::take_written()) {
      if (const auto answer = answers.push(byte)) answer_ = answer;
    }
    require(answers.malformed() == 0);
  }
  ReceivedTelemetry ask() {
    answer_.reset();
    send_frame(FrameType::status, {});
    check_answers();
    require(answer_.has_value());
    const auto telemetry = parse_telemetry(*answer_);
    require(telemetry.has_value());
    return *telemetry;
  }

  FrameDecoder decoder_;
  std::uint64_t frames_ = 0;
  // What the microcontroller counted in earlier inputs, whose counters wrap.
  std::uint64_t frames_unseen_ = 0;
  std::uint64_t malformed_unseen_ = 0;
  std::uint8_t sequence_ = 0;
  std::optional<Frame> answer_;
};

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  telehug::Bytes bytes(data, size);
  telehug::FuzzedWire wire;
  while (!bytes.empty())
    wire.step(bytes);
  wire.check_counts();
  return 0;
}
