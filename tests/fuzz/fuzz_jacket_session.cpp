// SPDX-License-Identifier: Apache-2.0
//
// A jacket that answers anything at any time. What is written to it stays in order: frames of the protocol, no motor or
// heater that it did not announce, none for longer than 250 ms or above 40 C, and nothing that drives before it
// answered a greeting. What it tells of itself is within what a jacket can be.
#include <algorithm>
#include <cstdlib>
#include <vector>

#include "doubles/fake_clock.hpp"
#include "fuzz/bytes.hpp"
#include "link/jacket_session.hpp"

namespace telehug {
namespace {

using protocol::FrameType;

void require(bool holds) {
  if (!holds) std::abort();
}

class FuzzedTalk {
 public:
  void step(Bytes& bytes) {
    switch (bytes.byte() % 8) {
      case 0:
        hear(bytes.text(bytes.byte()));
        break;
      case 1:
        answer(bytes);
        break;
      case 2:
        session_.connected(clock_.now());
        break;
      case 3:
        session_.disconnected();
        break;
      case 4:
        session_.stop_all();
        break;
      case 5:
        drive(bytes);
        break;
      case 6:
        heat(bytes);
        break;
      default:
        clock_.advance(std::chrono::milliseconds(bytes.byte() * 8));
        break;
    }
    write(bytes.byte() % 8 == 0);
    check_status();
  }

 private:
  void hear(const std::string& bytes) {
    const std::vector<std::uint8_t> heard(bytes.begin(), bytes.end());
    session_.receive(heard, clock_.now());
  }
  // A whole frame, often one that fits to what was written last.
  void answer(Bytes& bytes) {
    static constexpr FrameType types[]{FrameType::caps, FrameType::ack, FrameType::nack, FrameType::telemetry};
    Frame frame{types[bytes.byte() % 4], static_cast<std::uint8_t>(last_.sequence + bytes.byte() / 128U), {}};
    const std::string payload = bytes.text(bytes.byte() % protocol::payload_max_bytes);
    frame.payload.assign(payload.begin(), payload.end());
    if (frame.type == FrameType::caps && last_.type == FrameType::hello && bytes.byte() % 4 != 0) {
      frame.payload.resize(protocol::caps_bytes);
      frame.payload[0] = protocol::version;
      frame.payload[10] = last_.payload[2];
      frame.payload[11] = last_.payload[3];
    }
    if (frame.type == FrameType::caps && last_.type == FrameType::hello && frame.payload.size() > 4) {
      for (const std::size_t counts : {3U, 4U})
        frame.payload[counts] = static_cast<std::uint8_t>(frame.payload[counts] % 4);
    }
    if (frame.type == FrameType::telemetry && !frame.payload.empty()) {
      frame.payload.resize(protocol::telemetry_bytes + protocol::temperature_bytes * (frame.payload[0] % 3U));
    }
    if (frame.type == FrameType::ack) frame.payload.resize(1);
    if (frame.type == FrameType::nack) frame.payload.resize(2);
    const EncodedFrame encoded = encode(frame);
    session_.receive({encoded.data(), encoded.size()}, clock_.now());
  }
  void drive(Bytes& bytes) {
    MotorCommands commands;
    for (std::size_t n = bytes.byte() % (commands.capacity() + 1); n > 0; --n)
      commands.push_back({bytes.byte(), bytes.byte(), std::chrono::milliseconds(bytes.number<std::int16_t>())});
    require(session_.send(commands, clock_.now()) == session_.armed());
  }
  void heat(Bytes& bytes) {
    HeaterCommands commands;
    for (std::size_t n = bytes.byte() % (commands.capacity() + 1); n > 0; --n) {
      commands.push_back({bytes.byte(), bytes.number<std::int16_t>() / 100.0,
                          std::chrono::milliseconds(bytes.number<std::int16_t>())});
    }
    const bool taken = session_.heat(commands, clock_.now());
    require(!taken || (session_.armed() && session_.status().heater_count > 0));
  }
  void check_status() const {
    const LinkStatus& status = session_.status();
    require(status.motor_count <= protocol::motor_count && status.heater_count <= protocol::heater_count);
    if (!status.telemetry) return;
    for (const auto& heater : status.telemetry->heaters)
      require(!heater.celsius || (*heater.celsius >= -40 && *heater.celsius <= 150));
  }
  void write(bool has_backlog) {
    FrameDecoder decoder;
    std::optional<Frame> frame;
    const EncodedFrame written = session_.next_frame(clock_.now(), has_backlog);
    for (const std::uint8_t byte : written)
      if (auto found = decoder.push(byte)) frame = found;
    require(written.empty() || frame.has_value());
    if (!frame) return;
    last_ = *frame;
    require(!has_backlog || frame->type == FrameType::stop_all);
    if (frame->type == FrameType::heat) check_heat(*frame);
    if (frame->type != FrameType::set) return;
    require(session_.armed() && !frame->payload.empty() && frame->payload.size() % protocol::set_entry_bytes == 0);
    for (std::size_t at = 0; at < frame->payload.size(); at += protocol::set_entry_bytes)
      require(frame->payload[at] < session_.status().motor_count &&
              frame->payload[at + 2] <= protocol::drive_max_ms / 10);
  }

  void check_heat(const Frame& frame) const {
    const FramePayload& payload = frame.payload;
    require(session_.armed() && !payload.empty() && payload.size() % protocol::heat_entry_bytes == 0);
    for (std::size_t at = 0; at < payload.size(); at += protocol::heat_entry_bytes) {
      require(payload[at] < session_.status().heater_count);
      require((payload[at + 1] | payload[at + 2] << 8) <= protocol::heat_max_decidegrees);
      require(payload[at + 3] <= protocol::drive_max_ms / 10);
    }
  }

  FakeClock clock_;
  JacketSession session_;
  Frame last_;
};

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  telehug::Bytes bytes(data, size);
  telehug::FuzzedTalk talk;
  while (!bytes.empty())
    talk.step(bytes);
  return 0;
}
