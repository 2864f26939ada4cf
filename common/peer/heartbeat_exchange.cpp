// SPDX-License-Identifier: Apache-2.0
#include "peer/heartbeat_exchange.hpp"

#include <algorithm>
#include <utility>

namespace telehug {

HeartbeatExchange::HeartbeatExchange(SessionId session, Side side) {
  own_.session = std::move(session);
  own_.side = side;
}

const Heartbeat& HeartbeatExchange::beat(Timestamp now) {
  own_.sequence += 1;
  own_.sent_time_ns = to_ns(now);
  // The peer's beat may have come in since the caller looked at the clock.
  own_.echo_held_ns = own_.echo_session.empty() ? 0 : std::max<std::int64_t>(to_ns(now) - to_ns(peer_heard_), 0);
  next_due_ = (now - next_due_ < heartbeat_interval ? next_due_ : now) + heartbeat_interval;
  return own_;
}

void HeartbeatExchange::heard(const Heartbeat& peer, Timestamp now) {
  if (peer.session != own_.echo_session) {
    newest_.reset();
    smoothed_.reset();
    smallest_.reset();
  }
  own_.echo_session = peer.session;
  own_.echo_sent_time_ns = peer.sent_time_ns;
  peer_heard_ = now;
  late_ = path_.observe(peer.session, peer.sent_time_ns, now);

  if (peer.echo_session != own_.session) return;
  // Differences of int64 stamps that came from outside: an impossible one must not overflow.
  const std::int64_t now_ns = to_ns(now);
  if (peer.echo_sent_time_ns < 0 || peer.echo_sent_time_ns > now_ns) return;
  const std::int64_t away_ns = now_ns - peer.echo_sent_time_ns;
  if (peer.echo_held_ns < 0 || peer.echo_held_ns > away_ns) return;
  newest_ = std::chrono::nanoseconds(away_ns - peer.echo_held_ns);
  // SRTT of RFC 6298, alpha = 1/8.
  smoothed_ = smoothed_ ? *smoothed_ + (*newest_ - *smoothed_) / 8 : *newest_;
  smallest_ = std::min(smallest_.value_or(*newest_), *newest_);
}

std::optional<Duration> HeartbeatExchange::one_way() const noexcept {
  if (!smallest_) return {};
  return *smallest_ / 2 + late_;
}

}  // namespace telehug
