// SPDX-License-Identifier: Apache-2.0
//
// The wearer hugs back.
#include "daemon/hug_request.hpp"
#include "passive_daemon.hpp"

namespace telehug {

// It moves no motor, so a stop does not forbid it: who has had enough of being touched may still say this.
nlohmann::json PassiveDaemon::order_hug(const nlohmann::json& request) {
  const auto wanted = read_hug_request(request);
  if (!wanted) return {{"error", wanted.error().message}};
  if (wanted->duration) return {{"error", "a hug back is seen and heard, and has no length: leave the seconds out"}};
  if (!any_alive(connections())) return {{"error", "no peer is connected: nobody could see the hug"}};
  const std::lock_guard lock(hug_mutex_);  // a button and the command at once
  const auto hug = hug_back_.next(wanted->strength, clock_.now());
  if (!hug) {
    hugs_too_soon_.add();
    return {{"error", "the last hug went out less than a second ago"}};
  }
  // To everybody who may touch: the child does not choose.
  bool went_out = false;
  for (const auto& sender : senders_.all())
    went_out = sender->connection.beside().hugs().write(*hug) || went_out;
  if (!went_out) return {{"error", "the connection is not complete yet: hug again in a moment"}};
  hugs_sent_.add();
  control_->broadcast({{"event", "hug"}, {"side", "passive"}, {"strength", hug->strength}});
  return {{"side", "passive"}, {"hug", "sent"}};
}

}  // namespace telehug
