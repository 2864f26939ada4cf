// SPDX-License-Identifier: Apache-2.0
#include "daemon/pairing_desk.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "daemon/membership.hpp"
#include "pairing/pairing.hpp"
#include "pairing_link/pairing_code.hpp"
#include "pairing_link/pairing_exchange.hpp"
#include "pairing_link/qr_code.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr std::size_t longest_name = 64;

std::string text_in(const Json& request, const char* key) {
  const auto given = request.find(key);
  return given != request.end() && given->is_string() ? given->get<std::string>() : "";
}

// Installed beside the daemons.
std::filesystem::path pairing_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "telehug";
}

Json qr_of(const std::string& code) {
  const auto parsed = parse_pairing_code(code);
  return parsed ? Json(to_svg(make_qr_code(to_qr_text(*parsed)))) : Json();
}

}  // namespace

PairingDesk::PairingDesk(Side side, std::filesystem::path folder, std::string address, ControlServer& control)
    : side_(side), folder_(std::move(folder)), address_(std::move(address)) {
  control.on("pairing", [this](const Json& request) { return obey(request); });
}

std::optional<Json> PairingDesk::news() {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(changed_, false)) return std::nullopt;
  return state_;
}

Json PairingDesk::obey(const Json& request) {
  const std::string order = text_in(request, "order");
  if (order == "list") return list();
  if (order == "invite") return begin(request, true);
  if (order == "accept") return begin(request, false);
  if (order == "cancel") return cancel();
  if (order == "revoke") return revoke(request);
  return {{"error", "\"order\" is one of list, invite, accept, cancel, revoke"}};
}

Json PairingDesk::list() const {
  Json pairs = Json::array();
  for (const Pair& pair : PairStore(folder_, side_).list())
    pairs.push_back(pair_json(pair));
  return {{"side", side_name(side_)}, {"pairs", std::move(pairs)}};
}

Json PairingDesk::revoke(const Json& request) const {
  const std::string id = text_in(request, "id");
  PairStore store(folder_, side_);
  const auto pairs = store.list();
  if (std::ranges::find(pairs, id, &Pair::id) == pairs.end() || !store.revoke(id))
    return {{"error", "there is no such pair on this PC"}};
  return {{"side", side_name(side_)}, {"revoked", id}};
}

Json PairingDesk::begin(const Json& request, bool invites) {
  const std::string name = text_in(request, "name");
  if (name.size() > longest_name) return {{"error", "the name has 64 characters at most"}};
  std::vector<std::string> command{pairing_program().string(),     "pair",
                                   invites ? "invite" : "accept",  "--side=" + side_name(side_),
                                   "--folder=" + folder_.string(), "--json"};
  if (!name.empty()) command.push_back("--name=" + name);
  if (invites && !address_.empty()) command.push_back("--address=" + address_);
  if (!invites) {
    const auto code = parse_pairing_code(text_in(request, "code"));
    if (!code) return {{"error", code.error().message}};
    command.push_back(to_text(*code));
  }
  {
    const std::lock_guard lock(mutex_);
    if (runs_) return {{"error", "a pairing runs already: end it first"}};
    runs_ = true;
    changed_ = true;
    state_ = {{"state", invites ? "inviting" : "accepting"}};
  }
  run_ = std::make_unique<PairingRun>(std::move(command),
                                      PairingRun::Handlers{[this](const Json& told) { heard(told); },
                                                           [this](const std::string& problem) { over(problem); }});
  return {{"side", side_name(side_)}, {"pairing", "begun"}};
}

Json PairingDesk::cancel() {
  if (run_) run_->cancel();
  const std::lock_guard lock(mutex_);
  if (!runs_) {
    state_ = {{"state", "idle"}};
    changed_ = true;
  }
  return {{"side", side_name(side_)}, {"pairing", "ended"}};
}

void PairingDesk::heard(const Json& told) {
  const std::lock_guard lock(mutex_);
  changed_ = true;
  if (told.contains("pair")) {
    state_ = {{"state", "paired"}, {"pair", told["pair"]}};
  } else if (const std::string code = text_in(told, "code"); !code.empty()) {
    const auto ends = wall_time() + std::chrono::floor<std::chrono::seconds>(ExchangeLimits{}.invitation);
    state_ = {{"state", "inviting"}, {"code", code}, {"qr", qr_of(code)}, {"ends_s", ends.time_since_epoch().count()}};
  }
}

void PairingDesk::over(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  runs_ = false;
  changed_ = true;
  if (!problem.empty()) state_ = {{"state", "failed"}, {"problem", problem}};
}

}  // namespace telehug
