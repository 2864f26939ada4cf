// SPDX-License-Identifier: Apache-2.0
#include "ctl/doctor/behind_sudo.hpp"

#include <fmt/core.h>
#include <grp.h>
#include <pwd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace telehug {

std::optional<std::string> asker_behind_sudo() {
  const char* asker = std::getenv("SUDO_UID");
  if (::geteuid() != 0 || asker == nullptr) return std::nullopt;
  char* end = nullptr;
  const unsigned long user = std::strtoul(asker, &end, 10);
  if (*asker == '\0' || *end != '\0' || user == 0) return std::nullopt;
  const passwd* entry = ::getpwuid(static_cast<uid_t>(user));
  if (entry == nullptr) return std::nullopt;
  return entry->pw_name;
}

void become(const std::string& user) {
  const passwd* entry = ::getpwnam(user.c_str());
  const bool done = entry != nullptr && ::initgroups(entry->pw_name, entry->pw_gid) == 0 &&
                    ::setresgid(entry->pw_gid, entry->pw_gid, entry->pw_gid) == 0 &&
                    ::setresuid(entry->pw_uid, entry->pw_uid, entry->pw_uid) == 0;
  if (!done) throw std::system_error(errno, std::generic_category(), "root can't go on as " + user);
  ::setenv("HOME", entry->pw_dir, 1);
  // sudo drops it; root's own, where there is one, has not their daemons.
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime == nullptr || std::string(runtime) == "/run/user/0")
    ::setenv("XDG_RUNTIME_DIR", fmt::format("/run/user/{}", entry->pw_uid).c_str(), 1);
}

}  // namespace telehug
