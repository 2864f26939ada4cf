// SPDX-License-Identifier: Apache-2.0
//
// A jacket profile that somebody wrote by hand. What is read keeps what jacket_profile.hpp promises, since everything
// behind it relies on that.
#include <cstdlib>
#include <set>
#include <string>

#include "doubles/fake_jacket_link.hpp"
#include "doubles/temporary_folder.hpp"
#include "jacket/body_picture.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "jacket/touch_to_drives.hpp"
#include "safety/safety_stage.hpp"

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

// Throws if the profile is none.
void use(const JacketProfile& profile) {
  FakeJacket jacket;
  const SafetyStage safety(std::make_unique<FakeJacketLink>(jacket), profile, {});
  for (const BodySide side : {BodySide::front, BodySide::back})
    require(body_picture(profile, {}, side).size() <= static_cast<std::size_t>(body_picture_lines));
  Contact contact;
  contact.grid = {standard_columns, standard_rows};
  for (contact.box = 1; contact.box <= largest_box; ++contact.box)
    require(profile.uncovered == Uncovered::none || !actuators_at(contact, profile).empty());
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
