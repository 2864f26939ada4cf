// SPDX-License-Identifier: Apache-2.0
#include "ctl/pair_side.hpp"

#include <filesystem>
#include <system_error>

#include "ctl/daemons.hpp"
#include "service/control_socket.hpp"

namespace telehug {

namespace {

bool is_installed(Side side) {
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  return !failed && std::filesystem::exists(program.parent_path() / ("telehug-" + side_name(side)), failed);
}

bool runs(Side side) {
  return !find_daemons({.side = side_name(side), .socket = {}}).found.empty();
}

}  // namespace

Result<Side> side_of_this_pc(const std::string& given) {
  if (given == side_name(Side::active)) return Side::active;
  if (given == side_name(Side::passive)) return Side::passive;
  for (const auto is_here : {is_installed, runs}) {
    const bool active = is_here(Side::active);
    if (active != is_here(Side::passive)) return active ? Side::active : Side::passive;
  }
  return Error{"say whether this is the parent's PC (--side active) or the wearer's (--side passive)"};
}

}  // namespace telehug
