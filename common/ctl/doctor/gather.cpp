// SPDX-License-Identifier: Apache-2.0
#include "ctl/doctor/gather.hpp"

#include <fcntl.h>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "ctl/daemons.hpp"
#include "ctl/doctor/behind_sudo.hpp"
#include "ctl/doctor/checks.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr uid_t first_login = 1000;  // Debian Policy 9.2.2

// The sockets that this user may not use are left for what is known of their sides.
std::vector<fs::path> ask_daemons(DoctorFacts& facts) {
  std::vector<fs::path> denied;
  Daemons daemons = find_daemons({});
  for (Daemon& daemon : daemons.found) {
    auto status = daemon.client.ask({{"command", "status"}});
    if (status && status->is_object() && !status->contains("error"))
      facts.daemons.push_back(*std::move(status));
    else
      facts.unreachable_daemons.emplace_back("nobody answers on " + daemon.socket.string(),
                                             "its daemon hangs: start it again");
  }
  for (const Unreachable& daemon : daemons.unreachable)
    if (daemon.code == ExitCode::permission)
      denied.push_back(daemon.socket);
    else if (daemon.code != ExitCode::not_running)
      facts.unreachable_daemons.emplace_back(daemon.sentence, "run `sudo telehug doctor`");
  return denied;
}

// Whether a socket is in a folder that is closed to this user nobody can see: then the system's unit tells, if it can.
std::string denied_socket(const SideFacts& side, const std::vector<fs::path>& denied) {
  const bool unit_is_down = std::ranges::any_of(side.units, [](const UnitFacts& unit) {
    return !unit.user && unit.load == "loaded" && unit.active != "active" && unit.active != "activating";
  });
  for (const fs::path& socket : denied) {
    std::error_code hidden;
    const bool seen = fs::exists(socket, hidden);
    if (socket.stem() == side_name(side.side) && (seen || (hidden && !unit_is_down))) return socket.string();
  }
  return "";
}

bool groups_have(const Account& account, gid_t group) {
  std::array<char, 4096> room{};
  passwd entry{};
  passwd* found = nullptr;
  getpwnam_r(account.name.c_str(), &entry, room.data(), room.size(), &found);
  if (found == nullptr) return false;
  std::array<gid_t, 256> groups{};
  int count = static_cast<int>(groups.size());
  getgrouplist(account.name.c_str(), found->pw_gid, groups.data(), &count);
  const auto end = groups.begin() + std::clamp(count, 0, static_cast<int>(groups.size()));
  return std::find(groups.begin(), end, group) != end;
}

// Does the system's service run a side that is asked about?
bool is_the_systems(const DoctorWishes& wishes) {
  const std::vector<Side> both{Side::active, Side::passive};
  return std::ranges::any_of(wishes.sides.empty() ? both : wishes.sides,
                             [&](Side side) { return account_of(units_of(side, wishes.root), wishes.system).service; });
}

}  // namespace

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem))
    found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

std::string name_of_user(uid_t user) {
  std::array<char, 4096> room{};
  passwd entry{};
  passwd* found = nullptr;
  getpwuid_r(user, &entry, room.data(), room.size(), &found);
  return found == nullptr ? std::to_string(user) : found->pw_name;
}

Account own_account() {
  const uid_t user = ::geteuid();
  return {name_of_user(user), true, user != 0 && user < first_login};
}

ConfigSources sources_of(const Account& account, ConfigSources sources) {
  if (!account.self && !sources.only_file) sources.user_folder.clear();
  return sources;
}

bool may(const Account& account, const fs::path& path, int what) {
  if (account.self) return ::faccessat(AT_FDCWD, path.c_str(), what, AT_EACCESS) == 0;
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return false;
  const unsigned shift = name_of_user(status.st_uid) == account.name ? 6 : groups_have(account, status.st_gid) ? 3 : 0;
  const unsigned granted = (status.st_mode >> shift) & 7U;  // R_OK, W_OK and X_OK are the bits of a mode
  return (granted & static_cast<unsigned>(what)) == static_cast<unsigned>(what);
}

DeviceNode device_node(const fs::path& root, const fs::path& path, const Account& account) {
  return {("/" / path.lexically_relative(root)).string(), may(account, path, R_OK | W_OK)};
}

void add_named(std::vector<DeviceNode>& nodes, const fs::path& root, const std::string& name, const Account& account) {
  if (name.empty() || name == "auto") return;
  const fs::path path = root / fs::path(name).relative_path();
  std::error_code ignored;
  const bool known = std::ranges::find(nodes, name, &DeviceNode::path) != nodes.end();
  if (!known && fs::exists(path, ignored)) nodes.push_back(device_node(root, path, account));
}

DoctorFacts gather_facts(const DoctorWishes& asked) {
  DoctorFacts facts;
  DoctorWishes wishes = asked;
  gather_firewall(facts);
  const auto asker = asker_behind_sudo();
  facts.through_sudo = asker.has_value();
  const bool root_stays = asker && is_the_systems(wishes);
  if (asker && !root_stays) {
    become(*asker);
    if (!wishes.system) wishes.sources.user_folder = usual_config_sources().user_folder;
  }
  facts.asked_by = own_account().name;
  facts.kernel = content_of(wishes.root / "proc/version");
  const std::vector<fs::path> denied = ask_daemons(facts);
  for (const Side name : wishes.sides.empty() ? sides_here(wishes.sources, facts.daemons) : wishes.sides) {
    DoctorWishes of_side = wishes;
    SideFacts side;
    side.side = name;
    side.units = units_of(name, wishes.root);
    side.account = account_of(side.units, wishes.system);
    if (asker && root_stays && side.account.self) {
      facts.not_of_root.push_back(name);
      continue;
    }
    if (!talks(facts, name)) side.denied_socket = denied_socket(side, denied);
    of_side.sources = sources_of(side.account, wishes.sources);
    const StateOfService state(!side.account.self);
    side.config_faults = inspect_config(of_side.sources, name).faults;
    name == Side::active ? gather_active(facts, of_side, side) : gather_passive(facts, of_side, side);
    facts.sides.push_back(std::move(side));
  }
  gather_network(facts, wishes);
  return facts;
}

}  // namespace telehug
