// SPDX-License-Identifier: Apache-2.0
#include "ctl/pair_place.hpp"

#include <fmt/core.h>
#include <sys/stat.h>

#include "config/config_report.hpp"
#include "config/places.hpp"

namespace telehug {

Result<std::filesystem::path> place_of_pairs(Side side, const ConfigSources& sources, const std::string& command,
                                             uid_t caller, const std::filesystem::path& root) {
  const PeerConfig config =
      side == Side::active ? readable_active_config(sources).peer : readable_passive_config(sources).peer;
  const std::filesystem::path place = pairs_folder(config, side);
  if (side == Side::active || !config.pairs_folder.empty() || caller == 0) return place;
  struct stat services {};
  const bool is_there = ::stat((root / "var/lib/telehug").c_str(), &services) == 0;
  if (!is_there || services.st_uid == caller) return place;
  return Error{fmt::format(
      "this PC's telehug-passive is a service, which keeps the pairs: `sudo telehug pair {}`. If you start your own "
      "telehug-passive instead, name its folder: --folder {}",
      command, place.string())};
}

}  // namespace telehug
