// SPDX-License-Identifier: Apache-2.0
#include "peer_link/peer_link.hpp"

#include <algorithm>

#include "peer_link/pair_over.hpp"

namespace telehug {
namespace {

constexpr Duration last_word_travels = 300ms;

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

PeerLink::Endpoints::Endpoints(DdsParticipant& participant, PeerLink& owner)
    : heartbeat_writer(participant),
      status_writer(participant),
      stop_writer(participant),
      heartbeat_reader(participant,
                       [&owner](const Heartbeat& heartbeat) {
                         owner.heartbeat_slot_.put({heartbeat, owner.clock_.now()});
                       }),
      status_reader(participant, [&owner](const SideStatus& status) { owner.status_slot_.put(status); }),
      stop_reader(participant, [&owner](const StopAll& stop) { owner.stop_latch_.heard(stop); }) {}

std::uint64_t PeerLink::Endpoints::dropped() const noexcept {
  std::uint64_t dropped = 0;
  for (const ReaderCounters& counters :
       {heartbeat_reader.counters(), status_reader.counters(), stop_reader.counters()}) {
    dropped += counters.malformed + counters.invalid;
  }
  return dropped;
}

PeerLink::PeerLink(DdsParticipant& participant, Side side, const SessionId& session, Duration heartbeat_timeout,
                   const Clock& clock)
    : side_(side), session_(session), clock_(clock), exchange_(session, side), monitor_(heartbeat_timeout) {
  connect(participant);
}

void PeerLink::disconnect() {
  const std::scoped_lock locks(counting_, sending_);
  if (!endpoints_) return;
  dropped_before_ += endpoints_->dropped();
  endpoints_.reset();  // from here on no callback runs
}

void PeerLink::connect(DdsParticipant& participant) {
  disconnect();
  {
    const std::scoped_lock locks(counting_, sending_);
    endpoints_.emplace(participant, *this);
  }
  told_.reset();
  stop_to_tell_again_ = stop_told_.has_value();
  tell_stop_again();
}

std::optional<HeardHeartbeat> PeerLink::serve(Timestamp now) {
  auto heard = heartbeat_slot_.take();
  if (heard && !monitor_.heard(heard->heartbeat, heard->time)) heard.reset();
  if (heard) exchange_.heard(heard->heartbeat, heard->time);
  if (now >= exchange_.next_due()) {
    const std::unique_lock lock(sending_, std::try_to_lock);
    if (lock.owns_lock() && endpoints_) endpoints_->heartbeat_writer.write(exchange_.beat(now));
  }
  return heard;
}

PeerState PeerLink::state(Timestamp now) {
  return {monitor_.alive(now), monitor_.session(), exchange_.smoothed_round_trip(), exchange_.one_way(),
          monitor_.losses()};
}

void PeerLink::tell(const SideStatus& status) {
  tell_stop_again();
  if (!endpoints_ || (told_ && same(*told_, status))) return;
  if (write_with_reason(endpoints_->status_writer, status)) told_ = status;
}

void PeerLink::tell_pair_over(const std::string& version) {
  SideStatus last;
  last.session = session_;
  last.side = side_;
  last.version = version;
  last.reason = pair_over_reason;
  tell(last);
  if (endpoints_) endpoints_->status_writer.wait_until_heard(last_word_travels);
}

bool PeerLink::tell_stop(bool stop, const std::string& reason) {
  if (!endpoints_) return false;
  const std::uint64_t told_before = stop_told_ ? stop_told_->sequence : 0;
  const StopAll word{session_, side_, told_before + 1, stop, reason};
  if (!write_with_reason(endpoints_->stop_writer, word)) return false;
  stop_told_ = word;
  stop_to_tell_again_ = false;
  return true;
}

void PeerLink::tell_stop_again() {
  if (!endpoints_ || !stop_to_tell_again_) return;
  // The same word, of the same number: whoever had heard it hears nothing new.
  stop_to_tell_again_ = !write_with_reason(endpoints_->stop_writer, *stop_told_);
}

std::uint64_t PeerLink::dropped() const {
  const std::lock_guard lock(counting_);
  return dropped_before_ + (endpoints_ ? endpoints_->dropped() : 0);
}

}  // namespace telehug
