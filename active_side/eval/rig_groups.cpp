// SPDX-License-Identifier: Apache-2.0
#include "eval/rig_groups.hpp"

#include <cmath>

namespace telehug {

std::vector<std::string> groups_of(const RandomRig& rig) {
  const VirtualRigSettings& settings = rig.settings;
  const double turned_deg = std::hypot(settings.camera.pitch_deg, settings.camera.yaw_deg, settings.camera.roll_deg);
  const double k1 = settings.distortion_k1;
  return {"bezel " + rig.group.bezel,
          "light " + rig.group.light,
          "coat " + rig.group.coat,
          "desk " + rig.group.desk,
          turned_deg < 2.5  ? "camera < 2.5 deg"
          : turned_deg <= 5 ? "camera 2.5-5 deg"
                            : "camera > 5 deg",
          k1 < -0.03  ? "k1 < -0.03"
          : k1 > 0.03 ? "k1 > 0.03"
                      : "k1 near 0"};
}

std::string rest_group(const ScoredRest& rest, const std::string& coat) {
  if (rest.kind != "hover") return rest.kind == "nohand" ? "no hand" : rest.kind;
  constexpr double clearly_above_mm = 10;
  if (rest.hover_mm.value_or(0) < clearly_above_mm) return "hover < 10 mm";
  const bool mirrored = rest.notes.find("mirrored") != std::string::npos;
  return "hover >= 10 mm, " + coat + (mirrored ? ", mirrored" : "");
}

}  // namespace telehug
