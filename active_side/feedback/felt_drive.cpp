// SPDX-License-Identifier: Apache-2.0
#include "feedback/felt_drive.hpp"

#include <utility>

#include "feedback/felt_pulse.hpp"

namespace telehug {
namespace {

constexpr SenderNumber wearer = 0;

}  // namespace

FeltDrive::FeltDrive(JacketProfile profile, std::unique_ptr<JacketLink> link, double strength)
    : profile_(std::move(profile)), strength_(strength), safety_(std::move(link), profile_, {}) {}

void FeltDrive::feel(const Felt& answer, Timestamp now) {
  const auto pulse = felt_pulse(answer, profile_, strength_, now);
  if (!pulse) return;
  // The answer itself is the sign of life that vouches for its pulse.
  safety_.on_heartbeat(wearer, now);
  safety_.apply(wearer, *pulse, now);
}

void FeltDrive::follow_stop(bool stopped, Timestamp now) {
  if (stopped && !safety_.stopped()) safety_.stop("stopped", now);
  if (!stopped && safety_.stopped()) safety_.resume();
}

void FeltDrive::tick(Timestamp now) {
  safety_.tick(now);
}

std::string FeltDrive::problem() const {
  const LinkStatus& link = safety_.link_status();
  return link.state == LinkState::armed ? "" : link.device + ": " + link.problem;
}

}  // namespace telehug
