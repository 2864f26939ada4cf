// SPDX-License-Identifier: Apache-2.0
//
// Where a daemon's local socket lies, and how one daemon and no more gets it.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/messages.hpp"

namespace telehug {

// "active" or "passive".
[[nodiscard]] std::string side_name(Side side);

// Where a daemon that isn't told otherwise puts its socket: SIDE.sock in the first of $RUNTIME_DIRECTORY (set by
// systemd), $XDG_RUNTIME_DIR/telehug, /run/telehug (root), /tmp/telehug-UID that applies.
[[nodiscard]] std::filesystem::path default_control_socket(Side side);

// Where a client looks for the daemon of a side, in this order: as this user's, then as the system's.
[[nodiscard]] std::vector<std::filesystem::path> usual_control_sockets(Side side);

// Somebody else serves the same path.
class AlreadyRunning : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// control.group names a group that the socket can't be given to: a fault of the configuration.
class GroupUnusable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A listening unix stream socket, mode 0660. A file left by a daemon that died is replaced; one that is answered on is
// not. An empty file PATH.lock beside it, locked as long as this lives, decides between two that start at once; it
// stays behind, unlocked.
class ControlSocket {
 public:
  // `group`: who may use it besides the owner; empty: the owner's group. Makes the folder if need be.
  // Throws AlreadyRunning, GroupUnusable, or std::runtime_error with a sentence for a person.
  ControlSocket(std::filesystem::path path, const std::string& group);
  ~ControlSocket();
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;

  [[nodiscard]] int fd() const noexcept { return fd_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  void prepare_folder() const;
  void lock();
  void remove_stale_file() const;
  void listen(const std::string& group);
  void close() noexcept;

  std::filesystem::path path_;
  int lock_fd_ = -1;
  int fd_ = -1;
  bool bound_ = false;
};

}  // namespace telehug
