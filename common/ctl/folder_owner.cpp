// SPDX-License-Identifier: Apache-2.0
#include "ctl/folder_owner.hpp"

#include <fmt/format.h>
#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace telehug {

Status become_owner_of(const std::filesystem::path& folder) {
  if (geteuid() != 0) return Done{};
  std::filesystem::path existing = std::filesystem::absolute(folder);
  struct stat found {};
  while (::stat(existing.c_str(), &found) != 0 && existing.has_relative_path())
    existing = existing.parent_path();
  if (found.st_uid == 0) return Done{};
  // The groups first: without root's rights they could not be changed any more.
  if (setgroups(0, nullptr) != 0 || setresgid(found.st_gid, found.st_gid, found.st_gid) != 0 ||
      setresuid(found.st_uid, found.st_uid, found.st_uid) != 0) {
    return Error{fmt::format("can't work as the owner of {}: {}", existing.string(), std::strerror(errno))};
  }
  return Done{};
}

}  // namespace telehug
