// SPDX-License-Identifier: Apache-2.0
#include "link/make_link.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <string>

#include "link/jacket_session.hpp"
#include "link/legacy_session.hpp"
#include "link/recording_link.hpp"
#include "link/wire_link.hpp"
#include "wire/rfcomm_opener.hpp"

namespace telehug {
namespace {

// What follows the scheme, if it is this one and anything follows.
std::optional<std::string> after(std::string_view scheme, std::string_view spec) {
  if (!spec.starts_with(scheme) || spec.size() == scheme.size()) return std::nullopt;
  return std::string(spec.substr(scheme.size()));
}

// Of those that telehug-jacket-sim knows, the one that such a jacket has.
std::string board_of(const JacketProfile& profile) {
  if (profile.protocol == JacketProtocol::legacy) return "legacy";
  const bool heats = std::ranges::any_of(
      profile.actuators, [](const Actuator& actuator) { return actuator.kind == ActuatorKind::heater; });
  return heats ? "motors12_heaters2" : "motors16";
}

std::unique_ptr<Conversation> make_conversation(LinkProtocol protocol) {
  if (protocol == LinkProtocol::legacy) return std::make_unique<LegacySession>();
  return std::make_unique<JacketSession>();
}

std::unique_ptr<JacketLink> make_wire_link(std::unique_ptr<WireOpener> opener, LinkProtocol protocol) {
  return std::make_unique<WireLink>(std::move(opener), make_conversation(protocol));
}

}  // namespace

LinkOptions link_options(const JacketProfile& profile, int baud) {
  LinkOptions options;
  options.baud = static_cast<unsigned>(baud != 0 ? baud : profile.baud);
  if (profile.protocol == JacketProtocol::legacy) options.protocol = LinkProtocol::legacy;
  options.simulator.board = board_of(profile);
  return options;
}

Result<std::unique_ptr<JacketLink>> make_link(std::string_view spec, const LinkOptions& options) {
  try {
    if (spec == "simulated") {
      return std::unique_ptr<JacketLink>(
          std::make_unique<SimulatedLink>(options.simulator, make_conversation(options.protocol)));
    }
    if (auto path = after("serial:", spec)) {
      return make_wire_link(std::make_unique<SerialOpener>(*std::move(path), options.baud), options.protocol);
    }
    if (const auto device = after("rfcomm:", spec)) {
      if (const auto peer = parse_rfcomm_peer(*device)) {
        return make_wire_link(std::make_unique<RfcommOpener>(*peer), options.protocol);
      }
    }
    if (const auto file = after("record:", spec)) {
      return std::unique_ptr<JacketLink>(std::make_unique<RecordingLink>(*file));
    }
  } catch (const std::exception& problem) {
    return Error{problem.what()};
  }
  return Error{"\"" + std::string(spec) +
               "\" names no jacket: write serial:PATH, rfcomm:ADDRESS, simulated or record:FILE (for example "
               "serial:/dev/serial/by-id/..., serial:auto or rfcomm:00:11:22:33:44:55)"};
}

}  // namespace telehug
