// SPDX-License-Identifier: Apache-2.0
#include "peer_link/peer_link.hpp"

#include <algorithm>

namespace telehug {
namespace {

bool same(const SideStatus& a, const SideStatus& b) {
  return a.ready == b.ready && a.stopped == b.stopped && a.reason == b.reason;
}

// A reason may come from a file, a device or a user. A word to the peer must not be lost over it.
template <typename T>
bool write_with_reason(Writer<T>& writer, T message) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  std::ranges::replace_if(message.reason, is_control, ' ');
  if (writer.write(message)) return true;
  std::ranges::replace_if(
      message.reason, [](char c) { return (static_cast<unsigned char>(c) & 0x80U) != 0; }, '?');
  return writer.write(message);
}

}  // namespace

PeerLink::PeerLink(DdsParticipant& participant, Side side, const SessionId& session, Duration heartbeat_timeout,
                   const Clock& clock)
    : side_(side),
      session_(session),
      exchange_(session, side),
      monitor_(heartbeat_timeout),
      heartbeat_writer_(participant),
      status_writer_(participant),
      stop_writer_(participant),
      heartbeat_reader_(participant,
                        [this, &clock](const Heartbeat& heartbeat) {
                          heartbeat_slot_.put({heartbeat, clock.now()});
                        }),
      status_reader_(participant, [this](const SideStatus& status) { status_slot_.put(status); }),
      stop_reader_(participant, [this](const StopAll& stop) { stop_latch_.heard(stop); }) {}

std::optional<HeardHeartbeat> PeerLink::serve(Timestamp now) {
  auto heard = heartbeat_slot_.take();
  if (heard && !monitor_.heard(heard->heartbeat, heard->time)) heard.reset();
  if (heard) exchange_.heard(heard->heartbeat, heard->time);
  if (now >= exchange_.next_due()) heartbeat_writer_.write(exchange_.beat(now));
  return heard;
}

PeerState PeerLink::state(Timestamp now) {
  return {monitor_.alive(now), monitor_.session(), exchange_.smoothed_round_trip(), exchange_.one_way(),
          monitor_.losses()};
}

void PeerLink::tell(const SideStatus& status) {
  if (told_ && same(*told_, status)) return;
  if (write_with_reason(status_writer_, status)) told_ = status;
}

bool PeerLink::tell_stop(bool stop, const std::string& reason) {
  return write_with_reason(stop_writer_, {session_, side_, ++stops_told_, stop, reason});
}

std::uint64_t PeerLink::dropped() const noexcept {
  std::uint64_t dropped = 0;
  for (const ReaderCounters& counters :
       {heartbeat_reader_.counters(), status_reader_.counters(), stop_reader_.counters()}) {
    dropped += counters.malformed + counters.invalid;
  }
  return dropped;
}

}  // namespace telehug
