// SPDX-License-Identifier: Apache-2.0
//
// A jacket profile that somebody wrote by hand. What is read keeps what jacket_profile.hpp promises, since everything
// behind it relies on that.
#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

#include "doubles/fake_jacket_link.hpp"
#include "doubles/temporary_folder.hpp"
#include "jacket/body_picture.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "rendering/jacket_renderer.hpp"
#include "safety/safety_stage.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

bool within(double value, double least, double most) {
  return value >= least && value <= most;
}

void check(const JacketProfile& profile) {
  require(!profile.name.empty() && profile.baud > 0);
  require(!profile.actuators.empty() && profile.actuators.size() <= max_actuators);
  std::set<int> ids;
  std::set<int> channels;
  for (const Actuator& actuator : profile.actuators) {
    require(actuator.id != 0 && ids.insert(actuator.id).second);
    require(actuator.channel < motor_channels && channels.insert(actuator.channel).second);
    require(within(actuator.max_strength, 0, 1) && within(actuator.min_strength, 0, actuator.max_strength));
    require(within(actuator.place.x_fh, -5, 5) && within(actuator.place.y_fh, -5, 5));
    for (const std::uint16_t box : actuator.boxes)
      require(box >= 1 && box <= largest_box);
  }
}

// Whatever is touched is felt somewhere, if it shall be and anything may run.
void touch_everywhere(const JacketProfile& profile) {
  const bool felt =
      profile.uncovered == Uncovered::nearest && std::ranges::any_of(profile.actuators, [](const Actuator& actuator) {
        return actuator.enabled && actuator.kind == ActuatorKind::motor && actuator.max_strength > 0;
      });
  JacketRenderer renderer(profile, std::chrono::milliseconds(200));
  TouchEvent event;
  for (std::uint16_t box = 1; box <= largest_box; ++box) {
    event.contacts = {contact_in(box)};
    event.contacts[0].grid = {standard_columns, standard_rows};
    const JacketPlan& plan = renderer.plan(event, {}, {});
    for (const Drive& drive : plan.drives)
      require(within(drive.strength, 0, 1));
    require(!felt || plan.answers[0].outcome == FeltOutcome::driven);
  }
}

// Throws if the profile is none.
void use(JacketProfile profile) {
  FakeJacket jacket;
  const SafetyStage safety(std::make_unique<FakeJacketLink>(jacket), profile, {});
  for (const BodySide side : {BodySide::front, BodySide::back})
    require(body_picture(profile, {}, side).size() <= static_cast<std::size_t>(body_picture_lines));
  for (const Rendering rendering : {Rendering::boxes, Rendering::places}) {
    profile.rendering = rendering;
    touch_everywhere(profile);
  }
}

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace telehug;
  static const TemporaryFolder folder;
  const auto profile = load_jacket_profile(folder.write("jacket.toml", std::string(data, data + size)));
  if (!profile) {
    require(!profile.error().message.empty());
    return 0;
  }
  check(*profile);
  use(*profile);
  return 0;
}
