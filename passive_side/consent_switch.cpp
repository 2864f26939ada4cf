// SPDX-License-Identifier: Apache-2.0
#include "consent_switch.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <optional>
#include <utility>
#include <vector>

#include "common/names.hpp"
#include "config/quiet_hours_text.hpp"
#include "consent_file.hpp"
#include "daemon/status_parts.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

template <std::size_t size>
Json numbers_in(const std::bitset<size>& set) {
  Json list = Json::array();
  for (std::size_t number = 0; number < size; ++number)
    if (set.test(number)) list.push_back(number);
  return list;
}

std::optional<std::int64_t> whole_number(const Json& json, std::int64_t least, std::int64_t most) {
  if (!json.is_number_integer()) return std::nullopt;
  const auto number = json.get<std::int64_t>();  // one beyond its range becomes negative
  return number >= least && number <= most ? std::optional(number) : std::nullopt;
}

// Numbers 1 to `most` under `key`; none if the key is not there.
Result<std::vector<std::size_t>> numbers(const Json& request, const char* key, std::int64_t most) {
  std::vector<std::size_t> found;
  const auto list = request.find(key);
  if (list == request.end()) return found;
  const Error wrong{fmt::format("{} must be a list of numbers from 1 to {}", key, most)};
  if (!list->is_array()) return wrong;
  for (const Json& number : *list) {
    const auto value = whole_number(number, 1, most);
    if (!value) return wrong;
    found.push_back(static_cast<std::size_t>(*value));
  }
  return found;
}

// The time of day at which nothing is felt until; empty: none is known.
std::string end_of(const Consent& consent, FeltOutcome refusal, std::chrono::sys_seconds now) {
  if (refusal == FeltOutcome::quiet_hours) {
    const auto span = quiet_span_at(consent, local_minute(now));
    return span ? time_of_day_text(span->end_min) : "";
  }
  const bool ends = consent.pause && consent.pause->until;
  return ends ? time_of_day_text(local_minute(*consent.pause->until)) : "";
}

std::string until_text(const Consent& consent, FeltOutcome refusal, std::chrono::sys_seconds now) {
  const std::string end = end_of(consent, refusal, now);
  return end.empty() ? "until further notice" : "until " + end;
}

Json mutes_json(const Consent& consent) {
  return {{"side", "passive"},
          {"muted_boxes", numbers_in(consent.muted_boxes)},
          {"muted_actuators", numbers_in(consent.muted_actuators)}};
}

}  // namespace

ConsentSwitch::ConsentSwitch(std::filesystem::path file, QuietHours hours, const JacketProfile& profile)
    : file_(std::move(file)), profile_(profile) {
  if (auto kept = read_consent(file_)) {
    consent_ = *std::move(kept);
  } else {
    consent_.pause = Pause{};
    problem_ = problem_json(fmt::format("what the wearer wants is not known, so everything is paused: {} {}",
                                        file_.string(), kept.error().message),
                            "`telehug unpause` begins anew; what was muted is to be muted again before");
    spdlog::error("{}; {}", problem_.at("what").get<std::string>(), problem_.at("do").get<std::string>());
  }
  consent_.quiet_hours = std::move(hours);
}

void ConsentSwitch::serve(ControlServer& control, std::function<void()> changed) {
  changed_ = std::move(changed);
  control.on("pause", [this](const Json& request) {
    return pause(request, std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()));
  });
  control.on("unpause", [this](const Json&) { return unpause(); });
  control.on("mute", [this](const Json& request) { return mute(request, true); });
  control.on("strength", [this](const Json& request) { return strength(request); });
  control.on("quiet", [this](const Json& request) { return quiet(request); });
  control.on("unmute", [this](const Json& request) { return mute(request, false); });
}

Json ConsentSwitch::pause(const Json& request, std::chrono::sys_seconds now) {
  Consent wanted = consent();
  wanted.pause = Pause{};
  Json answer{{"side", "passive"}, {"paused", true}};
  if (const auto given = request.find("minutes"); given != request.end()) {
    const auto minutes = whole_number(*given, 1, longest_pause_min);
    if (!minutes) {
      return {{"error",
               fmt::format("a pause lasts 1 to {} whole minutes; without minutes it has no end", longest_pause_min)}};
    }
    wanted.pause->until = now + std::chrono::minutes(*minutes);
    answer["until"] = time_of_day_text(local_minute(*wanted.pause->until));
  }
  return set(wanted, std::move(answer));
}

Json ConsentSwitch::unpause() {
  Consent wanted = consent();
  wanted.pause.reset();
  return set(wanted, {{"side", "passive"}, {"paused", false}});
}

Json ConsentSwitch::mute(const Json& request, bool muted) {
  Consent wanted = consent();
  if (!muted && request.value("all", Json(false)) == true) {
    wanted.muted_boxes.reset();
    wanted.muted_actuators.reset();
    return set(wanted, mutes_json(wanted));
  }
  const auto boxes = numbers(request, "boxes", largest_box);
  const auto actuators = numbers(request, "actuators", 255);
  if (!boxes) return {{"error", boxes.error().message}};
  if (!actuators) return {{"error", actuators.error().message}};
  if (boxes->empty() && actuators->empty()) return {{"error", "which boxes or actuators? none are named"}};
  for (const std::size_t box : *boxes)
    wanted.muted_boxes.set(box, muted);
  for (const std::size_t id : *actuators) {
    // One that another jacket of the wearer's had may still be unmuted.
    if (muted && !profile_.index_of(static_cast<std::uint8_t>(id))) {
      return {{"error", fmt::format("\"{}\" has no actuator {}; `telehug jacket list` tells them", profile_.name, id)}};
    }
    wanted.muted_actuators.set(id, muted);
  }
  return set(wanted, mutes_json(wanted));
}

Json ConsentSwitch::strength(const Json& request) {
  const auto given = request.find("strength");
  const double strength = given != request.end() && given->is_number() ? given->get<double>() : 0;
  if (!(strength > 0 && strength <= 1))
    return {{"error", "the strength must be a number above 0, at most 1: the share of what the limits allow"}};
  Consent wanted = consent();
  wanted.strength = strength;
  return set(wanted, {{"side", "passive"}, {"strength", strength}});
}

Json ConsentSwitch::quiet(const Json& request) {
  const auto given = request.find("hours");
  if (given == request.end() || !given->is_string())
    return {{"error", "the hours must be a text such as \"20:30-07:00,13:00-14:00\"; an empty one: none"}};
  const auto hours = parse_quiet_hours(given->get<std::string>());
  if (!hours) return {{"error", hours.error().message}};
  Consent wanted = consent();
  wanted.own_quiet_hours = *hours;
  return set(wanted, {{"side", "passive"}, {"own_quiet_hours", quiet_hours_text(*hours)}});
}

void ConsentSwitch::set_configured_quiet_hours(QuietHours hours) {
  {
    const std::lock_guard lock(mutex_);
    consent_.quiet_hours = std::move(hours);
    newest_.put(consent_);
  }
  changed_();
}

Json ConsentSwitch::set(Consent consent, Json answer) {
  {
    const std::lock_guard lock(mutex_);
    // Those of the configuration may have changed since `consent` was copied, and no command sets them.
    consent.quiet_hours = consent_.quiet_hours;
    consent_ = consent;
    newest_.put(consent);
  }
  changed_();
  const Status kept = keep_consent(file_, consent);
  Json problem;
  if (!kept) {
    problem = problem_json("what the wearer wants is forgotten at the next start: " + kept.error().message,
                           "mend that, then say it again");
    spdlog::error("{}", problem.at("what").get<std::string>());
    answer = {{"error", "it is so now, but not after the next start: " + kept.error().message}};
  }
  const std::lock_guard lock(mutex_);
  problem_ = std::move(problem);
  return answer;
}

Consent ConsentSwitch::consent() const {
  const std::lock_guard lock(mutex_);
  return consent_;
}

Json ConsentSwitch::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

std::string refusal_text(const Consent& consent, std::chrono::sys_seconds now) {
  const auto refusal = permission_at(consent, now, local_minute(now)).refusal;
  return refusal ? fmt::format("{} {}", name_of(*refusal), until_text(consent, *refusal, now)) : "";
}

Json consent_json(const Consent& consent, std::chrono::sys_seconds now) {
  const auto refusal = permission_at(consent, now, local_minute(now)).refusal;
  Json json{{"name", refusal ? name_of(*refusal) : "open"}};
  if (refusal) json["why"] = until_text(consent, *refusal, now);
  if (refusal && !end_of(consent, *refusal, now).empty()) json["until"] = end_of(consent, *refusal, now);
  if (consent.strength < 1) json["strength"] = consent.strength;
  if (!consent.quiet_hours.empty()) json["quiet_hours"] = quiet_hours_text(consent.quiet_hours);
  if (!consent.own_quiet_hours.empty()) json["own_quiet_hours"] = quiet_hours_text(consent.own_quiet_hours);
  if (consent.muted_boxes.any()) json["muted_boxes"] = numbers_in(consent.muted_boxes);
  if (consent.muted_actuators.any()) json["muted_actuators"] = numbers_in(consent.muted_actuators);
  return json;
}

}  // namespace telehug
