// SPDX-License-Identifier: Apache-2.0
#include "files/folder_owner.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace telehug {
namespace {

void act_as(uid_t user, gid_t group) {
  if (user == geteuid() && group == getegid()) return;
  // Only root may change its group: as root in between.
  if (seteuid(getuid()) != 0 || setegid(group) != 0 || seteuid(user) != 0)
    throw std::system_error(errno, std::generic_category(), "can't act as the owner of the folder of pairs");
}

// What comes after would be done as somebody else than it should.
void act_as_or_end(uid_t user, gid_t group) noexcept {
  try {
    act_as(user, group);
  } catch (const std::system_error&) {
    std::abort();
  }
}

}  // namespace

AsOwnerOf::AsOwnerOf(std::filesystem::path folder) : user_(geteuid()), group_(getegid()) {
  if (user_ != 0 || getuid() != 0) return;
  std::error_code problem;
  folder = std::filesystem::absolute(folder, problem);
  struct stat facts {};
  while (lstat(folder.c_str(), &facts) != 0 || !S_ISDIR(facts.st_mode)) {
    if (folder == folder.parent_path()) return;
    folder = folder.parent_path();
  }
  act_as(facts.st_uid, facts.st_gid);
}

AsOwnerOf::~AsOwnerOf() {
  act_as_or_end(user_, group_);
}

AsCaller::AsCaller() : user_(geteuid()), group_(getegid()) {
  act_as(getuid(), getgid());
}

AsCaller::~AsCaller() {
  act_as_or_end(user_, group_);
}

}  // namespace telehug
