// SPDX-License-Identifier: Apache-2.0
#include "service/control_socket.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <grp.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace telehug {
namespace fs = std::filesystem;
namespace {

std::optional<fs::path> folder_from(const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr || *value != '/') return std::nullopt;
  // systemd lists several folders separated by colons; the first is the unit's main one.
  const std::string text = value;
  return fs::path(text.substr(0, text.find(':')));
}

fs::path fallback_folder() {
  return fmt::format("/tmp/telehug-{}", geteuid());
}

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
  throw std::runtime_error(fmt::format("can't serve the local socket {}: {}", path.string(), what));
}

[[noreturn]] void fail_with_errno(const fs::path& path, std::string_view doing) {
  fail(path, fmt::format("{}: {}", doing, std::strerror(errno)));
}

sockaddr_un address_of(const fs::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // The constructor has checked that it fits.
  std::memcpy(address.sun_path, path.c_str(), std::min(path.native().size(), sizeof(address.sun_path) - 1));
  return address;
}

[[noreturn]] void refuse_group(const std::string& name, std::string_view why) {
  throw GroupUnusable(
      fmt::format("control.group = \"{}\": {}. Leave it empty; with the packaged service `sudo usermod -aG telehug "
                  "NAME` lets NAME use "
                  "the socket after their next login",
                  name, why));
}

gid_t group_id(const std::string& name) {
  std::array<char, 16384> buffer{};
  group entry{};
  group* found = nullptr;
  getgrnam_r(name.c_str(), &entry, buffer.data(), buffer.size(), &found);
  if (found == nullptr) refuse_group(name, "there is no such group on this PC");
  return found->gr_gid;
}

[[noreturn]] void refuse(const fs::path& path) {
  throw AlreadyRunning(
      fmt::format("another telehug daemon already serves {}: stop it first, or give this one a control.socket of its "
                  "own",
                  path.string()));
}

}  // namespace

std::string side_name(Side side) {
  return side == Side::active ? "active" : "passive";
}

fs::path default_control_socket(Side side) {
  const std::string name = side_name(side) + ".sock";
  if (const auto folder = folder_from("RUNTIME_DIRECTORY")) return *folder / name;
  if (const auto folder = folder_from("XDG_RUNTIME_DIR")) return *folder / "telehug" / name;
  return (geteuid() == 0 ? fs::path("/run/telehug") : fallback_folder()) / name;
}

std::vector<fs::path> usual_control_sockets(Side side) {
  const std::string name = side_name(side) + ".sock";
  std::vector<fs::path> places;
  if (const auto folder = folder_from("XDG_RUNTIME_DIR")) places.push_back(*folder / "telehug" / name);
  places.push_back(fallback_folder() / name);
  places.push_back(fs::path("/run/telehug") / name);
  return places;
}

ControlSocket::ControlSocket(fs::path path, const std::string& group) : path_(std::move(path)) {
  if (path_.native().size() >= sizeof(sockaddr_un::sun_path)) fail(path_, "the path is longer than 107 bytes");
  try {
    prepare_folder();
    lock();
    remove_stale_file();
    listen(group);
  } catch (...) {
    close();
    throw;
  }
}

ControlSocket::~ControlSocket() {
  close();
}

void ControlSocket::prepare_folder() const {
  const fs::path folder = path_.parent_path();
  if (folder.empty()) return;
  std::error_code problem;
  if (!fs::exists(folder, problem)) {
    fs::create_directories(folder, problem);
    if (problem) fail(path_, fmt::format("its folder can't be made: {}", problem.message()));
    // Nobody else should find anything in a folder that lies where everybody may write.
    if (folder == fallback_folder()) fs::permissions(folder, fs::perms::owner_all, problem);
  }
  // In /tmp somebody else may have made the folder first, to answer in our place.
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0) fail_with_errno(path_, "its folder can't be looked at");
  if (status.st_uid != geteuid() && status.st_uid != 0) {
    fail(path_, "its folder belongs to another user; remove it, or choose another control.socket");
  }
}

void ControlSocket::lock() {
  const std::string file = path_.string() + ".lock";
  lock_fd_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (lock_fd_ < 0) fail_with_errno(path_, "its lock file can't be opened");
  if (flock(lock_fd_, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK) refuse(path_);
  fail_with_errno(path_, "its lock file can't be locked");
}

void ControlSocket::remove_stale_file() const {
  struct stat status {};
  if (lstat(path_.c_str(), &status) != 0) return;
  if (!S_ISSOCK(status.st_mode)) fail(path_, "there is a file there that isn't a socket; it is left alone");

  const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const sockaddr_un address = address_of(path_);
  const int result = connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const int problem = errno;
  ::close(probe);
  // EAGAIN: somebody listens and its backlog is full.
  if (result == 0 || problem == EAGAIN) refuse(path_);
  if (problem != ECONNREFUSED) {
    errno = problem;
    fail_with_errno(path_, "the socket there can't be tried");
  }
  if (unlink(path_.c_str()) != 0) fail_with_errno(path_, "the socket left there can't be removed");
}

void ControlSocket::listen(const std::string& group) {
  fd_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd_ < 0) fail_with_errno(path_, "no socket can be made");
  const sockaddr_un address = address_of(path_);
  if (bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    fail_with_errno(path_, "it can't be bound");
  }
  bound_ = true;
  // Nobody can connect before listen(), so nobody slips in before the permissions stand.
  if (!group.empty() && chown(path_.c_str(), static_cast<uid_t>(-1), group_id(group)) != 0) {
    refuse_group(group, fmt::format("this account may not give its socket to that group ({})", std::strerror(errno)));
  }
  if (chmod(path_.c_str(), 0660) != 0) fail_with_errno(path_, "its permissions can't be set");
  if (::listen(fd_, 16) != 0) fail_with_errno(path_, "it can't be listened on");
}

void ControlSocket::close() noexcept {
  if (bound_) unlink(path_.c_str());
  if (fd_ >= 0) ::close(fd_);
  if (lock_fd_ >= 0) ::close(lock_fd_);
}

}  // namespace telehug
